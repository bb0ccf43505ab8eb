#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace irido::schemas {

/// Prefix of the names of database materials, rii:SHELF/BOOK/PAGE.
inline constexpr std::string_view kDatabaseMark = "rii:";

/// A page of a copy of the refractiveindex.info database.
struct DatabasePage {
    std::string name;   ///< "rii:main/Ag/Johnson"
    std::string path;   ///< path of its file
    std::string words;  ///< titles of shelf, book and page, for searching
};

/// Selects the copy of the database to use from now on; "" for the one in the environment variable
/// IRIDO_MATERIALS. Must not be called while other threads use the database.
void use_material_database(const std::string& folder);

/// The folder of the copy in use, "" if there is none.
std::string material_database();

/// The file of the material of that name, with or without "rii:". Names are those of the catalogue
/// (catalog-nk.yml or library.yml, next to the data folder or above it). Without a catalogue, and
/// for files that it lacks, they follow folders and files: rii:main/Ag/Johnson is
/// main/Ag/nk/Johnson.yml, and rii:organic/ethanol/Rheims is organic/C2H6O - ethanol/nk/Rheims.yml.
/// Throws InputError without file and place if there is no database or no such page.
std::string database_file(std::string_view name);

/// All pages with linear indices, in catalogue order, or sorted by name without a catalogue. Throws
/// InputError if there is no database.
std::vector<DatabasePage> database_pages();

}  // namespace irido::schemas
