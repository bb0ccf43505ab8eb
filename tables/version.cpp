#include "tables/version.hpp"

#include "version.inc"

namespace irido::tables {

const Build& this_build() {
    static const Build build{IRIDO_VERSION, IRIDO_COMMIT};
    return build;
}

std::string version_text(const Build& build) {
    return build.commit.empty() ? build.version : build.version + " (" + build.commit + ")";
}

}  // namespace irido::tables
