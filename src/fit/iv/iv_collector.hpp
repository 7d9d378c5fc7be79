#pragma once
// Collects the points of I-V curves from the rows of several files.

#include <functional>
#include <map>
#include <span>
#include <tuple>

#include "fit/iv/iv_columns.hpp"

namespace corpuscle {

/// A row of a file.
struct IvRow {
    std::function<Result<double>(IvQuantity, const IvColumn&)> number;  ///< of a column, in SI; NaN: a missing bulk current
    std::function<Error(IvQuantity, std::string message)> error_at;
    std::string_view device = {};
};

class IvCollector {
    const IvOptions& options_;
    std::size_t files_;
    std::uint32_t file_ = 0;
    IvColumns columns_ = {};
    std::map<std::tuple<std::string, double, double>, std::uint32_t> known_devices_ = {};  // index of a name, W and L
    bool lacks_bulk_ = false, lacks_size_ = false, lacks_temperature_ = false;

    const std::optional<IvColumn>& column(IvQuantity q) const { return columns_[static_cast<std::size_t>(q)]; }
    std::optional<double> option(const std::vector<double>&) const;
    Result<double> value(const IvRow&, IvQuantity, double fallback) const;
    Result<double> voltage(const IvRow&, IvQuantity absolute, IvQuantity referred, double v_s, std::optional<double> constant) const;
    std::uint32_t device_index(IvDevice);

public:
    IvData data = {};

    IvCollector(const IvOptions& options, std::size_t files) : options_(options), files_(files) {}
    /// Checks the numbers and the ranges of the options.
    Result<void> check_options() const;
    /// Finds the columns of the next file or plot. `at`: the location of the headings.
    Result<void> begin_file(std::uint32_t file, std::span<const std::string> headings, SourceLocation at);
    Result<void> add(const IvRow&);
    /// Adds notes about what the files lack.
    void note_assumptions();

    /// The index of the column of a quantity in the present file; npos if it has none.
    std::size_t field_of(IvQuantity q) const { return column(q) ? column(q)->index : std::string::npos; }
};

}  // namespace corpuscle
