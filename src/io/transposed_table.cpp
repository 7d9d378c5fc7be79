#include "io/transposed_table.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <numeric>

#include "io/heading.hpp"
#include "io/samples.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t most_numbers_turned = std::size_t{1} << 27;  // a gigabyte

class MemorySamples final : public Samples {
    SamplesFacts facts_;
    std::vector<std::vector<double>> channels_;
    std::vector<Place> places_;  // of the rows that are the channels
    std::size_t names_;          // fields in front of the samples

public:
    MemorySamples(SamplesFacts facts, std::vector<std::vector<double>> channels, std::vector<Place> places, std::size_t names)
        : facts_(std::move(facts)), channels_(std::move(channels)), places_(std::move(places)), names_(names) {}

    std::optional<FieldPlace> place_of(std::int64_t row, std::size_t column) const override {
        return FieldPlace{places_[column], static_cast<std::size_t>(row) + names_ + 1};
    }

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
    const auto row_names = table->row_names();
    if (!row_names) return row_names.error();
    if (auto ok = table->rewind(); !ok) return ok.error();
    const std::size_t names = row_names->empty() ? 0 : 1;
    std::vector<std::size_t> all(table->columns().size() - names);
    std::iota(all.begin(), all.end(), names);
    std::vector<std::vector<double>> block(all.size()), channels;
    std::vector<Place> places;
    table->allow_gaps(true);  // checked again when the channels are read
    for (;;) {
        const auto rows = table->read(all, 64, block);
        if (!rows) return rows.error();
        if (*rows == 0) break;
        for (std::size_t k = 0; k < *rows; ++k) {
            channels.emplace_back(all.size());
            places.push_back(table->place(k));
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
    for (std::size_t c = 0; c < std::min(channels.size(), row_names->size()); ++c) facts.columns[c] = parse_heading((*row_names)[c]);
    return table_of(
        std::unique_ptr<Samples>(std::make_unique<MemorySamples>(std::move(facts), std::move(channels), std::move(places), names)), path);
}

}  // namespace corpuscle
