#pragma once

#include <string>
#include <string_view>

#include "core/periodic/bloch.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// A stack that consists of periods of two coherent layers of fixed thickness and nothing else, all
/// media having constant real indices.
struct OneMirror {
    RealLayer first, second;
    std::uint64_t repeat = 1;
    double n_in = 1, n_out = 1;
};

/// Why a stack is not a mirror ("a layer with k other than 0"); "" if it is one. Groups of one
/// repetition are transparent to this test, so a single period is a mirror, too.
std::string mirror_fault(const Stack& stack);

/// The same as a sentence that names the method.
std::string mirror_fault(std::string_view method, const Stack& stack);

/// Throws DomainError naming the method if the stack is not a mirror.
OneMirror one_mirror(std::string_view method, const Stack& stack);

}  // namespace irido
