#include "cli/options/command_line.hpp"

#include <algorithm>
#include <map>

#include "cli/options/command.hpp"
#include "core/nearest.hpp"

namespace irido::cli {

namespace {

using CLI::detail::expected_max_vector_size;

bool is_option_word(std::string_view word) {
    const bool is_number = word.size() > 1 && word[1] >= '0' && word[1] <= '9';
    return word.size() > 1 && word[0] == '-' && !is_number;
}

bool takes_nothing(const CLI::Option& option) {
    return option.get_items_expected_max() == 0;
}

/// Whether an option takes all words up to the next option.
bool takes_many(const CLI::Option& option) {
    return option.get_items_expected_max() >= expected_max_vector_size &&
           option.get_allow_extra_args();
}

bool may_repeat(const CLI::Option& option) {
    return takes_nothing(option) || option.get_items_expected_max() >= expected_max_vector_size;
}

/// "--wavelengths", or "STACK".
std::string name_of(const CLI::Option& option) {
    return option.get_name();
}

/// Checks the words of one command.
class CommandWords {
public:
    CommandWords(const CLI::App& command, std::string path)
        : command_(command), path_(std::move(path)) {}

    void read(std::span<char* const> words) {
        words_ = words;
        while (at_ < words_.size()) {
            const std::string_view word = words_[at_++];
            if (is_end_of_options_ || !is_option_word(word)) {
                positional(word);
            } else if (word == "--") {
                is_end_of_options_ = true;
            } else {
                option(word);
            }
        }
        require_compatible();
        require_complete();
    }

private:
    [[noreturn]] void fail(const std::string& text) const {
        throw UsageError(text + " (see " + path_ + " --help)");
    }

    const CLI::Option* find(std::string_view word) const {
        const bool is_long = word.starts_with("--");
        return command_.get_option_no_throw(
            std::string(word.substr(0, is_long ? word.find('=') : 2)));
    }

    /// The next word, unless it is an option's name.
    bool has_value() const { return at_ < words_.size() && !find_option(words_[at_]); }
    const CLI::Option* find_option(std::string_view word) const {
        return is_option_word(word) ? find(word) : nullptr;
    }

    void positional(std::string_view word) {
        ++positionals_;
        for (const CLI::Option* option : command_.get_options()) {
            if (!option->get_positional()) continue;
            const bool is_full =
                !takes_many(*option) && counts_[option] >= option->get_items_expected_max();
            if (is_full) continue;
            if (word.empty()) empty(*option);
            count(*option);
            return;
        }
        fail("unexpected argument '" + std::string(word) + "'" +
             (positionals_ > 1 && command_.get_option_no_throw("STACK")
                  ? "; put an expression in quotes"
                  : ""));
    }

    void option(std::string_view word) {
        const CLI::Option* const found = find(word);
        if (!found) unknown(word);
        const std::size_t equals = word.find('=');
        const bool is_attached = word.starts_with("--") ? equals != word.npos : word.size() > 2;
        const std::string_view attached =
            !is_attached ? "" : word.substr(word.starts_with("--") ? equals + 1 : 2);
        count(*found);
        if (takes_nothing(*found)) {
            if (is_attached && attached != "true" && attached != "false")
                fail(name_of(*found) + ": takes no value (got '" + std::string(attached) + "')");
            return;
        }
        if (counts_[found] > 1 && !may_repeat(*found))
            fail(name_of(*found) + ": given more than once");
        if (attached.empty()) value_of(*found);
        while (takes_many(*found) && at_ < words_.size() && !is_option_word(words_[at_]))
            if (std::string_view(words_[at_++]).empty()) empty(*found);
    }

    [[noreturn]] void empty(const CLI::Option& option) const {
        const std::string type = option.get_positional() ? name_of(option) : option.get_type_name();
        const char* const what = type == "DIR"                       ? "name a folder"
                                 : type == "FILE" || type == "SCENE" ? "name a file"
                                                                     : "not be empty";
        fail(name_of(option) + ": must " + what);
    }

    void value_of(const CLI::Option& option) {
        if (has_value()) {
            const std::string_view value = words_[at_++];
            const bool is_stream = value == "-" && option.get_type_name() == "DIR";
            if (value.empty() || is_stream) empty(option);
        } else if (option.get_items_expected_min() > 0) {
            fail(name_of(option) + ": requires a value, " + option.get_type_name());
        }
    }

    [[noreturn]] void unknown(std::string_view word) const {
        const std::string typed(word.substr(0, word.find('=')));
        std::vector<std::string> names;
        for (const CLI::Option* option : command_.get_options())
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        const std::string guess = typed.starts_with("--") ? did_you_mean(typed, names) : "";
        // options added by --compute
        const CLI::Option* const compute = command_.get_option_no_throw("--compute");
        const bool is_computing = std::ranges::any_of(words_, [](std::string_view other) {
            return other == "--compute" || other.starts_with("--compute=");
        });
        if (compute && guess.empty() && !is_computing)
            fail("--compute: is required for " + typed + ": spectrum, color, bands or cm");
        fail(path_.substr(path_.find(' ') + 1) + " has no option " + typed + guess);
    }

    void count(const CLI::Option& option) {
        if (counts_[&option]++ == 0) typed_.push_back(&option);
    }

    void require_compatible() const {
        for (const CLI::Option* option : typed_)
            for (const CLI::Option* other : option->get_excludes())
                if (std::ranges::find(typed_, other) != typed_.end())
                    fail(name_of(*option) + " and " + name_of(*other) + " cannot be used together");
    }

    void require_complete() const {
        for (const CLI::Option* option : command_.get_options())
            if (option->get_required() && std::ranges::find(typed_, option) == typed_.end())
                fail(name_of(*option) + " is required");
    }

    const CLI::App& command_;
    std::string path_;  ///< as typed: the program, groups of commands, the command
    std::span<char* const> words_;
    std::size_t at_ = 0;
    bool is_end_of_options_ = false;
    int positionals_ = 0;
    std::map<const CLI::Option*, int> counts_;
    std::vector<const CLI::Option*> typed_;  ///< each once, in command-line order
};

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App*) { return true; });
}

/// Checks a command of `parent` and the words that follow it.
void check(const CLI::App& parent, const std::string& path, std::span<char* const> words) {
    const std::vector<const CLI::App*> commands = commands_of(parent);
    if (commands.empty()) return CommandWords(parent, path).read(words);
    const std::string help = path + " --help";
    std::vector<std::string> names;
    for (const CLI::App* command : commands) names.push_back(command->get_name());
    if (words.empty() || std::string_view(words[0]).empty())
        throw UsageError("a command is required after " + path + " (see " + help + ")");
    const std::string typed = words[0];
    const auto found = std::ranges::find(names, typed);
    if (found != names.end())
        return check(*commands[static_cast<std::size_t>(found - names.begin())], path + " " + typed,
                     words.subspan(1));
    if (parent.get_option_no_throw(typed)) return;  // --help, --version
    if (typed.starts_with('-'))
        throw UsageError("a command is required after " + path + ", before " + typed + " (see " +
                         help + ")");
    throw UsageError("unknown command '" + typed + "'" + did_you_mean(typed, names) + " (see " +
                     help + ")");
}

/// The command given, below all groups of commands.
const CLI::App& typed_command(const CLI::App& program) {
    const std::vector<CLI::App*> parsed = program.get_subcommands();
    return parsed.empty() ? program : typed_command(*parsed.front());
}

}  // namespace

void add_missing_options(CLI::App& program) {
    for (CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
        if (!commands_of(*command).empty()) {
            add_missing_options(*command);
            continue;
        }
        if (!command->get_option_no_throw("--threads")) add_threads_option(*command);
        if (!command->get_option_no_throw("--quiet")) add_quiet_option(*command);
    }
}

void check_command_line(const CLI::App& program, std::span<char* const> words) {
    const auto asks_for_help = [](std::string_view word) {
        return word == "--help" || word == "-h";
    };
    if (std::ranges::any_of(words.subspan(1), asks_for_help)) return;
    check(program, program.get_name(), words.subspan(1));
}

void note_fallbacks(const CLI::App& program) {
    const CLI::App& command = typed_command(program);
    const bool is_quiet = command.count("--quiet") > 0;
    const CLI::Option& threads = *command.get_option("--threads");
    if (threads.count() > 0 && parse_threads(threads.results().back()) == kMostThreads &&
        threads.results().back() != std::to_string(kMostThreads))
        note("--threads: at most " + std::to_string(kMostThreads) + " are started (got " +
                 threads.results().back() + ")",
             is_quiet);
    const std::optional<SimdLevel> asked = asked_simd_level();
    if (asked && !is_available(*asked))
        note("IRIDO_SIMD: this machine does not support " + std::string(name_of(*asked)) +
                 ", using " + std::string(name_of(available_or_less(*asked))),
             is_quiet);
}

}  // namespace irido::cli
