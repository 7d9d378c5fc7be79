#include "io/table/table.hpp"

#include <fmt/format.h>
#include <cmath>

namespace corpuscle {

Result<std::vector<std::string>> Table::texts(std::size_t column) {
    TRY(rewind());
    const bool allowed = std::exchange(allows_gaps_, true);
    std::vector<std::string> out;
    for (std::vector<std::vector<double>> block(1);;) {
        const auto rows = read({column}, rows_per_block, block);
        if (!rows || *rows == 0) {
            allows_gaps_ = allowed;
            return rows ? Result<std::vector<std::string>>(std::move(out)) : rows.error();
        }
        for (std::size_t k = 0; k < *rows; ++k) {
            if (std::isnan(block[0][k])) {
                allows_gaps_ = allowed;
                return bad_input(fmt::format("'{}' is not a number here; in this format only numbers can identify trials, so save the table "
                                             "as CSV",
                                             columns()[column].name),
                                 location(k));
            }
            out.push_back(fmt::format("{}", block[0][k]));
        }
    }
}

}  // namespace corpuscle
