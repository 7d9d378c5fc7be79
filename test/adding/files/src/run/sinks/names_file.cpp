// names.txt: the name and channel of each afferent, one in each line.

#include "run/sinks/file_sink.hpp"

namespace corpuscle {
namespace {

class NamesFile final : public FileSink {
public:
    using FileSink::FileSink;
    Result<void> open() { return create("names.txt"); }
    Result<void> begin(const Input& input) override {
        std::string lines;
        for (const auto& name : afferent_csv_names(input.population)) lines += name + "\n";
        return files_[0].write(lines);
    }
};

}  // namespace

extern const OutputFormat names_format = {
    .names = {"names.txt"},
    .option = "--names",
    .help = "with --out, also write names.txt: the name of each afferent",
    .make = make_file_sink<NamesFile>,
};

}  // namespace corpuscle
