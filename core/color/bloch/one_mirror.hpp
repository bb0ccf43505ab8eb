#pragma once

#include <string>
#include <string_view>

#include "core/periodic/bloch.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// A stack that is nothing but periods of two coherent layers of one thickness each, all media of
/// constant real index: as values.
struct OneMirror {
    RealLayer first, second;
    std::uint64_t repeat = 1;
    double n_in = 1, n_out = 1;
};

/// What keeps a stack from being one ("a layer with k other than 0"); "" if it is one. Groups that
/// stand once are read through, so that one period is a mirror too.
std::string mirror_fault(const Stack& stack);

/// Throws DomainError that names the method if it is none.
OneMirror one_mirror(std::string_view method, const Stack& stack);

}  // namespace irido
