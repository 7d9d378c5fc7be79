#pragma once
// What each copy of a population is, and how it answered.

#include "measure/measures.hpp"
#include "model/spread.hpp"
#include "study/files.hpp"

namespace corpuscle {

/// copies.csv: afferent,channel, a column for each parameter that differs (f_B_Hz; empty for an afferent whose own does not), then
/// every measure over the whole input, empty where it has no value. A row a copy and channel, input after input. A parameter has all
/// its digits: set to it, the afferent answers as the copy did.
class CopiesFile final : public WrittenFile {
    struct Column {
        std::string_view parameter, unit;
        std::vector<std::string> afferents;  // for which it differs
    };
    OutputFile file_;
    std::vector<Column> columns_;
    Clock since_start_;  // of the input at work, its first sample at 0 s
    Tally tally_;        // by that clock
    fmt::memory_buffer text_;

    void put_row(const Input&, std::size_t unit);

public:
    CopiesFile(OutputFile file, const Copies&);
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const Answered&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override { return file_.commit(); }
};

}  // namespace corpuscle
