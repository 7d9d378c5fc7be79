// One channel of hexadecimal integers, one in each line.

#include <cmath>
#include <fstream>

#include "io/recording/recording_formats.hpp"
#include "io/recording/samples.hpp"

namespace corpuscle {
namespace {

class HexadecimalSamples final : public Samples {
    std::vector<double> values_;

public:
    explicit HexadecimalSamples(std::vector<double> values) : values_(std::move(values)) {
        info_.columns = {{"hexadecimal", ""}}, info_.rows = static_cast<std::int64_t>(values_.size());
    }
    Result<void> fetch(std::int64_t first, std::size_t rows, std::span<const std::size_t> wanted,
                       std::vector<std::vector<double>>& out) override {
        for (std::size_t k = 0; k < wanted.size(); ++k)
            std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(first), rows, out[k].begin());
        return {};
    }
};

}  // namespace

Result<std::unique_ptr<Table>> open_hexadecimal_table(const std::string& path, const TableOptions&) {
    std::ifstream file(path);
    std::vector<double> values;
    for (unsigned value = 0; file >> std::hex >> value;) values.push_back(value);
    return make_table(std::unique_ptr<Samples>(std::make_unique<HexadecimalSamples>(std::move(values))), path);
}

}  // namespace corpuscle
