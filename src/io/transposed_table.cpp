#include "io/transposed_table.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <numeric>

#include "io/samples.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t most_numbers_turned = std::size_t{1} << 27;  // a gigabyte

class MemorySamples final : public Samples {
    SamplesFacts facts_;
    std::vector<std::vector<double>> channels_;

public:
    MemorySamples(SamplesFacts facts, std::vector<std::vector<double>> channels)
        : facts_(std::move(facts)), channels_(std::move(channels)) {}

    const SamplesFacts& facts() const override { return facts_; }

    Result<void> fetch(std::int64_t first, std::size_t rows, std::span<const std::size_t> wanted,
                       std::vector<std::vector<double>>& out) override {
        for (std::size_t i = 0; i < wanted.size(); ++i)
            std::copy_n(channels_[wanted[i]].begin() + static_cast<std::ptrdiff_t>(first), rows, out[i].begin());
        return {};
    }
};

}  // namespace

Result<std::unique_ptr<Table>> transposed(std::unique_ptr<Table> table, const std::string& path) {
    std::vector<std::size_t> all(table->columns().size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::vector<std::vector<double>> block(all.size()), channels;
    table->allow_gaps(true);  // checked again when the channels are read
    for (;;) {
        const auto rows = table->read(all, 64, block);
        if (!rows) return rows.error();
        if (*rows == 0) break;
        for (std::size_t k = 0; k < *rows; ++k) {
            channels.emplace_back(all.size());
            for (std::size_t c = 0; c < all.size(); ++c) channels.back()[c] = block[c][k];
        }
        if (channels.size() * all.size() > most_numbers_turned)
            return bad_input(fmt::format("--transpose: more than {} numbers are too many to turn; save the table with a row a sample",
                                         most_numbers_turned),
                             {path});
    }
    SamplesFacts facts;
    facts.rows = static_cast<std::int64_t>(all.size());
    facts.columns = columns_named_after("", channels.size());
    return table_of(std::unique_ptr<Samples>(std::make_unique<MemorySamples>(std::move(facts), std::move(channels))), path);
}

}  // namespace corpuscle
