#pragma once
// A table of the parameters and measures of each copy.

#include "measure/measures.hpp"
#include "model/copies.hpp"
#include "run/sinks/file_sinks.hpp"

namespace corpuscle {

/// copies.csv: one row for each copy on each channel, input after input. The columns are afferent, channel, each parameter that differs
/// between copies (f_B_Hz), and every measure over the complete input. A field is empty if the copies of this afferent do not differ in the
/// parameter, or if the measure has no value. Parameters are written with all digits, so that they reproduce the copy's response.
class CopiesFile final : public FileSink {
    struct Column {
        std::string_view parameter, unit;
        std::vector<std::string> afferents;  // names of the afferents whose copies differ in the parameter
    };
    OutputFile file_;
    std::vector<Column> columns_;  // of the parameters
    Clock since_start_;            // of the current input, with its first sample at 0 s
    MeasureAccumulator tally_;     // the measures of every afferent of the current input; times on that clock
    fmt::memory_buffer text_;

    /// Appends the row of an afferent to text_; the index is within the input, from 0.
    void put_row(const Input&, std::size_t afferent_index);

public:
    CopiesFile(OutputFile file, const CopySpec&);
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override { return file_.commit(); }
};

}  // namespace corpuscle
