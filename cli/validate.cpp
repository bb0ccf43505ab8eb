#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/command.hpp"
#include "schemas/input_error.hpp"
#include "tables/atomic_file.hpp"

namespace irido {

namespace {

constexpr int kInvalid = 1, kUnreadable = 2;

int run_validate(const std::vector<std::string>& files) {
    std::string out;
    int status = 0;
    for (const std::string& file : files) {
        try {
            const std::vector<std::string> problems = validate_stack_file(file);
            for (const std::string& line : problems) out += line + '\n';
            if (problems.empty()) out += file + ": ok\n";
            if (!problems.empty()) status = std::max(status, kInvalid);
        } catch (const InputError& error) {
            std::cerr << "irido: error: " << error.what() << '\n';
            status = kUnreadable;
        }
    }
    write_stdout(out);
    return status;
}

}  // namespace

void add_validate_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "validate", "Check stack files: every error of every file, or FILE: ok.");
    const auto files = std::make_shared<std::vector<std::string>>();
    const auto schema = std::make_shared<bool>(false);
    CLI::Option* flag = command->add_flag(
        "--schema", *schema, "print the JSON Schema of stack files, which explains every key");
    command->add_option("FILE", *files, "stack files (.json), - for standard input")
        ->excludes(flag);
    set_examples(*command,
                 {"irido validate schemas/examples/*.json", "irido validate - < stack.json"});
    command->footer(command->get_footer() +
                    "\n\nExit status: 0 if all are right, 1 if not, 2 if a file cannot be read.");
    command->callback([files, schema, &run] {
        if (*schema) {
            run = [] {
                write_stdout(stack_schema_text());
                return 0;
            };
        } else if (files->empty()) {
            throw UsageError("validate: FILE is required (see irido validate --help)");
        } else {
            run = [files] { return run_validate(*files); };
        }
    });
}

}  // namespace irido
