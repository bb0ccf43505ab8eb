#include <algorithm>
#include <memory>

#include "cli/manual/manual.hpp"
#include "cli/options/command.hpp"
#include "core/nearest.hpp"
#include "tables/files/atomic_file.hpp"
#include "tables/version.hpp"

namespace irido::cli {

namespace {

struct ManualCommand {
    std::vector<std::string> command;
    std::string folder;
};

std::string current_man_page(const CommandPage& program, const CommandPage& page) {
    return man_page(program, page, program.name + " " + tables::this_build().version);
}

const CommandPage& page_of(const CommandPage& program, const std::vector<std::string>& command) {
    const CommandPage* page = &program;
    for (const std::string& word : command) {
        const std::string path = page->name + " ";
        const CommandPage* next = nullptr;
        std::vector<std::string> names;
        for (const CommandPage* one : all_pages(program)) {
            if (!one->name.starts_with(path) || one->name.find(' ', path.size()) != path.npos)
                continue;
            names.push_back(one->name.substr(path.size()));
            if (names.back() == word) next = one;
        }
        if (!next)
            throw UsageError("unknown command '" + joined(command, " ") + "'" +
                             did_you_mean(word, names));
        page = next;
    }
    return *page;
}

std::vector<std::string> command_names(const CLI::App& program) {
    std::vector<std::string> names;
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

int run_manual(const CLI::App& app, const ManualCommand& command) {
    const CommandPage program = command_page(app);
    const CommandPage& chosen = page_of(program, command.command);
    if (command.folder.empty()) {
        tables::write_stdout(current_man_page(program, chosen));
        return 0;
    }
    for (const CommandPage* page : all_pages(chosen))
        tables::write_file(command.folder + "/" + page_name(*page) + ".1",
                           current_man_page(program, *page));
    return 0;
}

struct Shell {
    std::string_view name;
    std::string (*completion)(const CommandPage& program);
};

constexpr std::array kShells{Shell{"bash", bash_completion}, Shell{"zsh", zsh_completion},
                             Shell{"fish", fish_completion}};

std::vector<std::string_view> shell_names() {
    std::vector<std::string_view> names;
    for (const Shell& shell : kShells) names.push_back(shell.name);
    return names;
}

int run_completion(const CLI::App& app, const std::string& shell, const std::string& file) {
    const auto found = std::ranges::find(kShells, shell, &Shell::name);
    if (found == kShells.end()) throw UsageError("SHELL: " + not_one_of(shell_names(), shell));
    write_bytes(found->completion(command_page(app)), {file, ""}, false);
    return 0;
}

}  // namespace

void add_manual_command(CLI::App& program, Run& run) {
    CLI::App* command =
        program.add_subcommand("manual", "The manual page of irido or of one of its commands.");
    const auto typed = std::make_shared<ManualCommand>();
    command->add_option("COMMAND", typed->command, "such as spectrum, or lut color [irido itself]");
    offer(*command, "COMMAND", [&program] { return command_names(program); });
    command
        ->add_option("-o,--output", typed->folder,
                     "write it and those of all commands below it into this folder")
        ->type_name("DIR");
    set_examples(*command,
                 {"irido manual spectrum | man -l -", "irido manual -o ~/.local/share/man/man1"},
                 "Pages are troff (man macros); view them with man -l.");
    command->callback([&program, typed, &run] {
        run = [&program, typed] { return run_manual(program, *typed); };
    });
}

void add_completion_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "completion", "Shell completion of commands, options and their values.");
    struct Typed {
        std::string shell, file;
    };
    const auto typed = std::make_shared<Typed>();
    command->add_option("SHELL", typed->shell, "bash, zsh or fish")->required();
    offer(*command, "SHELL", shell_names);
    command
        ->add_option_function<std::string>(
            "-o,--output",
            [typed](const std::string& file) { typed->file = file == "-" ? "" : file; },
            "write to FILE; - is standard output [-]")
        ->type_name("FILE");
    set_examples(*command,
                 {"source <(irido completion bash)", "irido completion zsh -o ~/.zfunc/_irido",
                  "irido completion fish -o ~/.config/fish/completions/irido.fish"});
    command->callback([&program, typed, &run] {
        run = [&program, typed] { return run_completion(program, typed->shell, typed->file); };
    });
}

}  // namespace irido::cli
