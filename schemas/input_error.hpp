#pragma once

#include <string>
#include <utility>

#include "core/error.hpp"

namespace irido::schemas {

/// Bad input: one line for the user. `where` is a JSON pointer, "line:column" or empty.
/// what() is "FILE: WHERE: message" with empty parts left out.
struct InputError : Error {
    InputError(std::string file_name, std::string place, const std::string& text)
        : Error((file_name.empty() ? "" : file_name + ": ") + (place.empty() ? "" : place + ": ") +
                text),
          file(std::move(file_name)),
          where(std::move(place)),
          message(text) {}

    std::string file;
    std::string where;
    std::string message;
};

}  // namespace irido::schemas
