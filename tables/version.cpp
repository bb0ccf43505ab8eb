#include "tables/version.hpp"

#include "version.inc"

namespace irido {

const Build& this_build() {
    static const Build build{IRIDO_VERSION, IRIDO_COMMIT};
    return build;
}

std::string to_text(const Build& build) {
    return build.commit.empty() ? build.version : build.version + " (" + build.commit + ")";
}

}  // namespace irido
