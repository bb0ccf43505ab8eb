#pragma once

#include <string>

namespace irido::tables {

/// Version and commit that a program was built from.
struct Build {
    std::string version;  ///< "0.1.0"
    /// "cc98dd7a1b2c", with "-dirty-" and a checksum of the changes if the sources differ from that
    /// commit; "" outside a checkout.
    std::string commit;

    bool operator==(const Build&) const = default;
};

/// The build of this program.
const Build& this_build();

/// "0.1.0 (cc98dd7a1b2c)", or only the version if the commit is unknown.
std::string version_text(const Build& build);

}  // namespace irido::tables
