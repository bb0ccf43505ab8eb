#pragma once

#include <string>
#include <vector>

namespace irido::test {

using Words = std::vector<std::string>;

/// The words of both.
Words operator+(Words words, const Words& more);

/// Output and exit status of a run of the program.
struct Outcome {
    int status = -1;
    std::string out, err;
};

/// Runs the built irido with these arguments in `folder`, with `input` on standard input.
Outcome run_irido(const Words& arguments, const std::string& input = "",
                  const std::string& folder = IRIDO_SOURCE_DIR);

/// The same for a run that must succeed, or only its output.
Outcome done(const Words& arguments, const std::string& input = "",
             const std::string& folder = IRIDO_SOURCE_DIR);
std::string out_of(const Words& arguments);

/// Runs a shell command in `folder`; $IRIDO is the built program.
Outcome run_shell(const std::string& command, const std::string& folder);

/// Checks for exit status 2, nothing on standard output, and one line on standard error that
/// contains `error`.
void check_refused(const Outcome& outcome, const std::string& error);

/// An empty folder that is removed with its contents at the end.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::string& path() const { return path_; }
    std::string operator/(const std::string& name) const { return path_ + "/" + name; }

private:
    std::string path_;
};

std::string read_file(const std::string& path);
void write_text(const std::string& path, const std::string& text);

/// Rows of a CSV without quotes, the header first.
std::vector<std::vector<std::string>> parse_csv(const std::string& text);

}  // namespace irido::test
