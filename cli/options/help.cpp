#include <algorithm>

#include "cli/options/command.hpp"

namespace irido::cli {

namespace {

/// CLI11's pages, with an explanation of LIST below the options that take one.
class HelpPages : public CLI::Formatter {
public:
    std::string make_footer(const CLI::App* command) const override {
        const std::string footer = Formatter::make_footer(command);
        return takes_list(*command) ? "LIST: " + std::string(kListHelp) + "\n\n" + footer : footer;
    }

    /// Without the type of a positional argument, which its name says.
    std::string make_option_opts(const CLI::Option* option) const override {
        constexpr std::string_view kType = " TEXT";
        std::string words = Formatter::make_option_opts(option);
        if (option->get_positional() && words.starts_with(kType)) words.erase(0, kType.size());
        return words;
    }
};

}  // namespace

bool takes_list(const CLI::App& command) {
    return std::ranges::any_of(command.get_options(), [](const CLI::Option* option) {
        const std::string type = option->get_type_name();
        return type == "LIST" || type.ends_with("=LIST");
    });
}

std::string wrapped(const std::string& text, std::size_t width) {
    std::string lines = text;
    std::size_t line = 0, blank = std::string::npos;
    int brackets = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        brackets += lines[i] == '[' ? 1 : lines[i] == ']' ? -1 : 0;
        if (lines[i] == ' ' && brackets == 0) blank = i;
        if (lines[i] == '\n') {
            line = i + 1;
            blank = std::string::npos;
        } else if (i - line >= width && blank != std::string::npos) {
            lines[blank] = '\n';
            line = blank + 1;
            blank = std::string::npos;
        }
    }
    return lines;
}

void set_help_pages(CLI::App& program) {
    constexpr std::size_t kColumn = 26;
    const auto pages = std::make_shared<HelpPages>();
    pages->column_width(kColumn);
    pages->label("Excludes", "not with");
    program.formatter(pages);
}

}  // namespace irido::cli
