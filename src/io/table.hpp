#pragma once
// What every file of samples is to us: named columns of numbers, read in blocks, as often as needed.

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

struct Column {
    std::string name;
    std::string unit;  ///< as the file says it; "" if it says none
};

inline constexpr std::size_t rows_a_block = 4096;

class Table {
public:
    virtual ~Table() = default;
    virtual const std::vector<Column>& columns() const = 0;
    /// Which column is the time, if the file shows it ...
    virtual std::optional<std::size_t> time_column() const = 0;
    /// ... by its name, or only by how it runs.
    virtual bool time_is_guessed() const = 0;
    /// Reads up to `rows` rows of the columns `wanted` into out[i]; fewer than asked for only at the end.
    virtual Result<std::size_t> read(const std::vector<std::size_t>& wanted, std::size_t rows, std::vector<std::vector<double>>& out) = 0;
    virtual Result<void> rewind() = 0;
    /// How much of the file has been read, 0 to 1.
    virtual double done() const = 0;
    /// Where row number `row` of the last block stands, for messages.
    virtual Place place(std::size_t row) const = 0;
};

}  // namespace corpuscle
