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
};

}  // namespace

bool takes_list(const CLI::App& command) {
    return std::ranges::any_of(command.get_options(), [](const CLI::Option* option) {
        const std::string type = option->get_type_name();
        return type == "LIST" || type.ends_with("=LIST");
    });
}

void set_help_pages(CLI::App& program) {
    constexpr std::size_t kColumn = 26;
    const auto pages = std::make_shared<HelpPages>();
    pages->column_width(kColumn);
    program.formatter(pages);
}

}  // namespace irido::cli
