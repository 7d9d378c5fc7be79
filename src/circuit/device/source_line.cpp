// Reads the specification of a V or I source: DC, AC and time waveform.

#include <fmt/format.h>
#include <algorithm>

#include "circuit/device/source_waveform.hpp"
#include "circuit/expression/spice_number.hpp"
#include "circuit/netlist/element_reader.hpp"
#include "core/parameter.hpp"

namespace corpuscle::circuit {
namespace {

using Shape = Waveform::Shape;

const WaveformSyntax* shape_of(std::string_view word) {
    for (const auto& row : waveform_syntaxes)
        if (row.name == word) return &row;
    return nullptr;
}

class SourceLine {
    ElementReader& line_;
    Waveform& out_;
    std::size_t k_ = 3;                      // index of the next word; at first, the one after the name and two nodes
    std::vector<std::size_t> number_words_;  // for each of out_.numbers, the index of its word

public:
    explicit SourceLine(ElementReader& line) : line_(line), out_(line.element.waveform) {}

    Result<void> read() {
        if (is_number_next()) TRY(dc());
        while (!is_done()) TRY(next_item());
        for (const std::string_view name : {"dc", "ac", "td", "r"})
            if (const auto* pair = line_.find(name)) TRY(named(name, *pair));
        return {};
    }

private:
    bool is_done() const { return k_ >= line_.word_count(); }
    bool is_keyword(std::size_t k) const {
        const auto w = line_.text(k);
        return line_.is_plain(k) && (w == "dc" || w == "ac" || shape_of(w));
    }
    bool is_number_next() const {
        if (is_done() || is_keyword(k_)) return false;
        return !line_.is_plain(k_) || parse_number(line_.text(k_)) || line_.is_parameter(k_);
    }
    Result<double> number() { return line_.number(k_++); }

    Result<void> dc() {
        if (is_done() || is_keyword(k_)) return line_.error_at(k_, "dc must be followed by a number");
        if (out_.has_dc) return line_.error_at(k_, "dc is given twice");
        const auto value = TRY(number());
        out_.dc = value, out_.has_dc = true;
        return {};
    }

    Result<void> ac() {
        out_.ac_magnitude = 1;
        for (double* to : {&out_.ac_magnitude, &out_.ac_phase}) {
            if (is_done() || is_keyword(k_)) return {};
            *to = TRY(number());
        }
        return {};
    }

    /// Reads dc, ac or a time waveform with its numbers.
    Result<void> next_item() {
        const auto w = line_.text(k_);
        if (w == "dc") return ++k_, dc();
        if (w == "ac") return ++k_, ac();
        const auto* row = shape_of(w);
        if (!row) return line_.error_at(k_, "{}", unknown(w));
        if (out_.shape != Shape::none) return line_.error_at(k_, "only one time waveform is allowed, not also '{}'", w);
        ++k_;
        return shape(*row);
    }

    static std::string unknown(std::string_view w) {
        constexpr std::string_view known[] = {"dc", "ac", "pulse", "sin", "exp", "pwl", "force"};
        if (w == "sffm" || w == "am" || w == "trnoise" || w == "trrandom" || w == "external")
            return fmt::format("{} sources are not supported; known are pulse, sin, exp, pwl and force", w);
        return fmt::format("unknown word '{}'{}", w, did_you_mean(w, known));
    }

    Result<void> shape(const WaveformSyntax& row) {
        out_.shape = row.shape;
        const auto keyword = k_ - 1;
        while (!is_done() && !is_keyword(k_)) {
            number_words_.push_back(k_);
            out_.numbers.push_back(TRY(number()));
        }
        const auto n = out_.numbers.size();
        if (n < row.min_numbers || n > row.max_numbers)
            return line_.error_at(keyword, "{} has {} number{}; expected {}{}", row.name, n, n == 1 ? "" : "s", row.usage,
                                  n > row.max_numbers ? fmt::format(" with at most {}", row.max_numbers) : "");
        if (row.shape == Shape::force && n == 0) out_.numbers = {1};
        return row.shape == Shape::piecewise_linear ? check_points() : Result<void>();
    }

    /// Checks the points of a pwl.
    Result<void> check_points() {
        const auto& x = out_.numbers;
        if (x.size() % 2) return line_.error_at(number_words_.back(), "pwl has {} numbers; expected pairs of a time and a value", x.size());
        for (std::size_t k = 2; k < x.size(); k += 2)
            if (x[k] <= x[k - 2]) return line_.error_at(number_words_[k], "pwl: time {:g} must be later than {:g}", x[k], x[k - 2]);
        return {};
    }

    /// Reads dc=, ac=, or td= of a pwl.
    Result<void> named(std::string_view name, const NameValue& pair) {
        const auto value = TRY(line_.number(pair));
        if (name == "dc" && !out_.has_dc)
            out_.dc = value, out_.has_dc = true;
        else if (name == "ac" && out_.ac_magnitude == 0)
            out_.ac_magnitude = value;
        else if (name == "td" && out_.shape == Shape::piecewise_linear)
            for (std::size_t k = 0; k < out_.numbers.size(); k += 2) out_.numbers[k] += value;
        else if (name == "r" && out_.shape == Shape::piecewise_linear)
            return line_.error_at(pair.name, "a repeated pwl (r=) is not supported");
        else if (name == "td" || name == "r")
            return line_.error_at(pair.name, "{}= is allowed only with pwl", name);
        else if (name == "dc" || name == "ac")
            return line_.error_at(pair.name, "{} is given twice", name);
        return {};
    }
};

}  // namespace

Result<void> read_waveform(ElementReader& line) { return SourceLine(line).read(); }

}  // namespace corpuscle::circuit
