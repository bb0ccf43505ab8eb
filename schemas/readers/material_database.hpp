#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace irido::schemas {

/// Materials of a database are named rii:SHELF/BOOK/PAGE.
inline constexpr std::string_view kDatabaseMark = "rii:";

/// A page of a copy of the refractiveindex.info database.
struct DatabasePage {
    std::string name;   ///< "rii:main/Ag/Johnson"
    std::string path;   ///< of its file
    std::string words;  ///< titles of shelf, book and page, for searches
};

/// Uses that copy of the database from now on; "" for the one that the environment variable
/// IRIDO_MATERIALS names. Not to be called while others read from it.
void use_material_database(const std::string& folder);

/// The folder of the copy in use, "" if there is none.
std::string material_database();

/// The file of a material of that name, with or without "rii:". Names are those of the catalogue
/// (catalog-nk.yml or library.yml, beside the folder of data or above it); without one, and for
/// files that it lacks, those of folders and files: rii:main/Ag/Johnson is main/Ag/nk/Johnson.yml,
/// and rii:organic/ethanol/Rheims is organic/C2H6O - ethanol/nk/Rheims.yml. Throws InputError
/// without file and place if there is no database or no such page.
std::string database_file(std::string_view name);

/// All pages of linear indices, in the order of the catalogue, else of their names. Throws
/// InputError if there is no database.
std::vector<DatabasePage> database_pages();

}  // namespace irido::schemas
