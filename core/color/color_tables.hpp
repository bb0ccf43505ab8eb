#pragma once

#include "core/color/sensitivity.hpp"

namespace irido {

/// What the colours of all stacks under one sensitivity have in common. Parts are computed when
/// they are first asked for, once. Safe from many threads.
class ColorTables {
public:
    explicit ColorTables(Sensitivity sensitivity) : sensitivity_(std::move(sensitivity)) {}

    const Sensitivity& sensitivity() const { return sensitivity_; }

private:
    Sensitivity sensitivity_;
};

}  // namespace irido
