#include "schemas/readers/material_database.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "core/nearest.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/column_text.hpp"
#include "schemas/readers/number.hpp"
#include "schemas/readers/text_file.hpp"
#include "schemas/readers/utf8.hpp"

namespace irido::schemas {

namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

/// A page of a database and the path of its file.
struct Page {
    std::string shelf, book, page;
    std::string path, words;
    std::set<std::string> other_books = {};  ///< other names of the book
};

/// A plain or quoted YAML scalar, possibly followed by a comment.
std::string scalar(std::string_view text) {
    text = trimmed(text);
    if (text.size() >= 2 && (text[0] == '"' || text[0] == '\'')) {
        const std::size_t end = text.find(text[0], 1);
        if (end != std::string_view::npos) return std::string(text.substr(1, end - 1));
    }
    if (const std::size_t comment = text.find(" #"); comment != std::string_view::npos)
        text = trimmed(text.substr(0, comment));
    return std::string(text);
}

/// Text without HTML tags.
std::string without_tags(const std::string& text) {
    std::string plain;
    bool is_tag = false;
    for (const char c : text) {
        if (c == '<') is_tag = true;
        if (!is_tag) plain += c;
        if (c == '>') is_tag = false;
    }
    return plain;
}

/// The folder below a catalogue that its paths start from: data, or data-nk until 2023.
fs::path data_folder(const fs::path& catalogue, const std::string& first_path) {
    for (const char* name : {"data", "data-nk", "."}) {
        const fs::path folder = catalogue.parent_path() / name;
        if (is_there(folder / first_path)) return folder;
    }
    return catalogue.parent_path() / "data";
}

/// The pages of a catalogue: of its nested lists, only the lines SHELF, BOOK, PAGE, name and data
/// are needed.
std::vector<Page> catalogue_pages(const fs::path& catalogue) {
    std::vector<Page> pages;
    Page current;
    std::string shelf_name, book_name;
    enum class Level { shelf, book, page, other } level = Level::other;
    const std::string text = read_text(catalogue.string(), TextSource::regular_file);
    for (const TextLine& line : lines_of(text)) {
        std::string_view rest = trimmed(line.text);
        if (rest.starts_with("- ")) rest = trimmed(rest.substr(2));
        const std::size_t colon = rest.find(':');
        if (colon == std::string_view::npos || rest.starts_with('#')) continue;
        const std::string_view key = rest.substr(0, colon);
        const std::string value = scalar(rest.substr(colon + 1));
        if (key == "SHELF") {
            current.shelf = value;
            shelf_name = "";
            level = Level::shelf;
        } else if (key == "BOOK") {
            current.book = value;
            book_name = "";
            level = Level::book;
        } else if (key == "PAGE") {
            current.page = value;
            current.words = "";
            level = Level::page;
        } else if (key == "DIVIDER") {
            level = Level::other;
        } else if (key == "name" && level == Level::shelf) {
            shelf_name = without_tags(value);
        } else if (key == "name" && level == Level::book) {
            book_name = without_tags(value);
        } else if (key == "name" && level == Level::page) {
            current.words = shelf_name + " " + book_name + " " + without_tags(value);
        } else if (key == "data" && level == Level::page) {
            current.path = value;
            pages.push_back(current);
        }
    }
    if (!pages.empty()) {
        const fs::path folder = data_folder(catalogue, pages.front().path);
        for (Page& found : pages) found.path = (folder / found.path).string();
    }
    return pages;
}

/// The titles in a book's about.yml: the list NAMES.
std::string titles_in(const fs::path& about) {
    if (!is_there(about)) return "";
    std::string titles;
    bool is_inside = false;
    const std::string text = read_text(about.string(), TextSource::regular_file);
    for (const TextLine& line : lines_of(text)) {
        const std::string_view content = trimmed(line.text);
        if (content.starts_with("- ")) {
            if (is_inside) titles += " " + without_tags(scalar(content.substr(2)));
        } else if (!content.empty() && !content.starts_with('#')) {
            is_inside = content.starts_with("NAMES:");
        }
    }
    return titles;
}

/// Alternative names of a book whose folder is "C2H6O - ethanol": either part.
std::set<std::string> parts_of(const std::string& book) {
    std::set<std::string> names;
    const std::size_t dash = book.find(" - ");
    if (dash == std::string::npos) return names;
    names.insert(book.substr(0, dash));
    names.insert(book.substr(dash + 3));
    return names;
}

/// The page of a file, from its path: SHELF/BOOK/nk/PAGE.yml, with other folders below specs.
std::optional<Page> placed_page(const fs::path& base, const fs::path& file) {
    const fs::path place = file.lexically_relative(base);
    std::vector<std::string> steps;
    for (const fs::path& step : place) steps.push_back(step.string());
    if (steps.size() < 2 || place.stem() == "about") return std::nullopt;
    Page page{steps.front(), "", place.stem().string(), file.string(), ""};
    std::vector<std::string> books(steps.begin() + 1, steps.end() - 1);
    for (const std::string& step : books)
        if (step == "n2") return std::nullopt;
    std::string with_group;
    const bool has_nk = !books.empty() && books.back() == "nk";
    if (has_nk) books.pop_back();
    for (std::size_t i = 0; i < books.size(); ++i) {
        with_group += (i > 0 ? "/" : "") + books[i];
        if (!has_nk && i + 2 == books.size()) page.other_books.insert(with_group);
    }
    page.book = with_group;
    for (const std::string& name : parts_of(page.book)) page.other_books.insert(name);
    page.words = page.shelf + " " + page.book + " " + page.page;
    return page;
}

fs::path base_folder(const fs::path& folder) {
    for (const char* name : {"database/data", "data", "data-nk", "database/data-nk"})
        if (is_there(folder / name)) return folder / name;
    return folder;
}

/// All pages below a folder, sorted.
std::vector<Page> folder_pages(const fs::path& folder) {
    const fs::path base = base_folder(folder);
    std::vector<Page> pages;
    std::map<fs::path, std::string> titles;
    std::error_code failure;
    const auto options = fs::directory_options::skip_permission_denied;
    for (auto at = fs::recursive_directory_iterator(base, options, failure);
         !failure && at != fs::recursive_directory_iterator(); at.increment(failure)) {
        const std::string ending = at->path().extension().string();
        if (ending != ".yml" && ending != ".yaml") continue;
        std::optional<Page> page = placed_page(base, at->path());
        if (!page) continue;
        fs::path book = at->path().parent_path();
        if (book.filename() == "nk") book = book.parent_path();
        if (!titles.contains(book)) titles[book] = titles_in(book / "about.yml");
        page->words += titles[book];
        pages.push_back(std::move(*page));
    }
    std::ranges::sort(pages, {}, &Page::path);
    return pages;
}

std::optional<fs::path> catalogue_of(const fs::path& folder) {
    for (const char* name :
         {"catalog-nk.yml", "database/catalog-nk.yml", "library.yml", "database/library.yml"})
        if (is_there(folder / name)) return folder / name;
    return std::nullopt;
}

/// A copy of the database, read on first use.
struct Database {
    std::mutex lock;
    std::string folder;  ///< "" for the one in the environment
    std::optional<std::vector<Page>> catalogue, placed;

    std::string where() const {
        if (!folder.empty()) return folder;
        const char* const named = std::getenv("IRIDO_MATERIALS");
        return named ? named : "";
    }
    fs::path required() const {
        const std::string path = where();
        if (path.empty())
            throw InputError("", "",
                             "there is no database: --database DIR or IRIDO_MATERIALS names the "
                             "folder of a copy of the refractiveindex.info database");
        std::error_code ignored;
        if (!fs::is_directory(path, ignored))
            throw InputError(path, "", "the material database must be a folder");
        return path;
    }
    const std::vector<Page>& in_catalogue() {
        if (!catalogue) {
            const auto file = catalogue_of(required());
            catalogue = file ? catalogue_pages(*file) : std::vector<Page>{};
        }
        return *catalogue;
    }
    const std::vector<Page>& in_folders() {
        if (!placed) placed = folder_pages(required());
        return *placed;
    }
};

Database& database() {
    static Database all;
    return all;
}

std::string name_of(const Page& page) {
    return page.shelf + "/" + page.book + "/" + page.page;
}

bool is_named(const Page& page, std::string_view name) {
    if (name_of(page) == name) return true;
    return std::ranges::any_of(page.other_books, [&](const std::string& book) {
        return page.shelf + "/" + book + "/" + page.page == name;
    });
}

const Page* page_named(const std::vector<Page>& pages, std::string_view name) {
    const auto found =
        std::ranges::find_if(pages, [&](const Page& page) { return is_named(page, name); });
    return found == pages.end() ? nullptr : &*found;
}

/// Tries SHELF/BOOK/nk/PAGE.yml and SHELF/BOOK/PAGE.yml, without listing all files.
std::optional<std::string> direct_file(const fs::path& folder, const std::string& name) {
    const std::size_t slash = name.rfind('/');
    if (slash == std::string::npos) return std::nullopt;
    const fs::path base = base_folder(folder);
    for (const char* between : {"/nk/", "/"}) {
        const fs::path file =
            base / (name.substr(0, slash) + between + name.substr(slash + 1) + ".yml");
        if (is_there(file)) return file.string();
    }
    return std::nullopt;
}

}  // namespace

void use_material_database(const std::string& folder) {
    Database& all = database();
    const std::scoped_lock guard(all.lock);
    all.folder = folder;
    all.catalogue.reset();
    all.placed.reset();
}

std::string material_database() {
    Database& all = database();
    const std::scoped_lock guard(all.lock);
    return all.where();
}

std::string database_file(std::string_view name) {
    if (name.starts_with(kDatabaseMark)) name.remove_prefix(kDatabaseMark.size());
    Database& all = database();
    const std::scoped_lock guard(all.lock);
    const fs::path folder = all.required();
    const std::string wanted(name);
    if (wanted.find("..") != std::string::npos || std::ranges::count(wanted, '/') < 2 ||
        !is_well_formed(wanted))
        throw InputError("", "", "must be rii:SHELF/BOOK/PAGE (got " + in_quotes(wanted) + ")");
    if (const Page* page = page_named(all.in_catalogue(), name)) return page->path;
    if (const auto file = direct_file(folder, wanted)) return *file;
    if (const Page* page = page_named(all.in_folders(), name)) return page->path;
    std::vector<std::string> known;
    const std::vector<Page>& pages =
        all.in_catalogue().empty() ? all.in_folders() : all.in_catalogue();
    for (const Page& page : pages) known.push_back(std::string(kDatabaseMark) + name_of(page));
    throw InputError("", "",
                     "there is no page " + std::string(kDatabaseMark) + wanted + " in " +
                         folder.string() +
                         did_you_mean(std::string(kDatabaseMark) + wanted, known) +
                         "; irido materials find searches it");
}

std::vector<DatabasePage> database_pages() {
    Database& all = database();
    const std::scoped_lock guard(all.lock);
    const std::vector<Page>& pages =
        all.in_catalogue().empty() ? all.in_folders() : all.in_catalogue();
    std::vector<DatabasePage> result;
    for (const Page& page : pages)
        result.push_back({std::string(kDatabaseMark) + name_of(page), page.path,
                          page.shelf + " " + page.book + " " + page.page + " " + page.words});
    return result;
}

}  // namespace irido::schemas
