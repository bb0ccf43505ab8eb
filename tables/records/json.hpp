#pragma once

#include <string>

#include "tables/records/records.hpp"

namespace irido {

/// A JSON array with one object a record, one record a line; numbers in their shortest form.
std::string write_json(const Records& records);

/// What stands between its brackets: "\n{...},\n{...}".
std::string json_rows(const Records& records);

}  // namespace irido
