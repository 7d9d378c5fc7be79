#pragma once
// Runs the program `corpuscle` in a temporary folder, through the shell.

#include <sys/wait.h>

#include "support/support.hpp"

namespace corpuscle::test {

struct ProgramResult {
    int status;            ///< exit status
    std::string out, err;  ///< standard output, standard error
};

/// `arguments`: as in a shell, with its quoting.
inline ProgramResult run_program(const TemporaryFolder& folder, const std::string& arguments) {
    const auto out = folder / ".out", err = folder / ".err";
    const int status = std::system(
        ("cd '" + folder.path() + "' && '" + test::program_path() + "' " + arguments + " >'" + out + "' 2>'" + err + "'").c_str());
    ProgramResult ran{WEXITSTATUS(status), read_file(out), read_file(err)};
    std::filesystem::remove(out);
    std::filesystem::remove(err);
    return ran;
}

}  // namespace corpuscle::test
