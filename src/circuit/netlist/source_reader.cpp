// Reads the specification of a V or I source: DC, AC and time waveform.

#include <fmt/format.h>
#include <algorithm>

#include "circuit/expression/spice_number.hpp"
#include "circuit/netlist/circuit_builder.hpp"
#include "core/parameter.hpp"

namespace corpuscle::circuit {
namespace {

using Shape = Waveform::Shape;

struct WaveformSyntax {
    std::string_view name;
    Shape shape;
    std::size_t min_numbers, max_numbers;  // allowed counts of numbers after the name
    std::string_view usage;
};
constexpr WaveformSyntax shapes[] = {
    {"pulse", Shape::pulse, 2, 8, "pulse(v1 v2 td tr tf pw per np)"},
    {"sin", Shape::sine, 2, 6, "sin(vo va freq td theta phase)"},
    {"exp", Shape::exponential, 2, 6, "exp(v1 v2 td1 tau1 td2 tau2)"},
    {"pwl", Shape::piecewise_linear, 2, max_elements, "pwl(t1 v1 t2 v2 ...)"},
    {"force", Shape::force, 0, 1, "force [scale]"},
};
const WaveformSyntax* shape_of(std::string_view word) {
    for (const auto& row : shapes)
        if (row.name == word) return &row;
    return nullptr;
}

class SourceReader {
    const Scope& scope_;
    const Statement& s_;
    std::size_t k_ = 3;  // index of the next word; at first, the one after the name and two nodes
    Waveform out_;
    std::vector<std::size_t> number_words_;  // for each of out_.numbers, the index of its word

public:
    SourceReader(const Scope& scope, const Statement& s) : scope_(scope), s_(s) {}

    Result<Waveform> read() {
        if (is_number_next()) TRY(dc());
        while (k_ < s_.words.size()) TRY(next_item());
        for (const auto& pair : s_.pairs) TRY(named(pair));
        return std::move(out_);
    }

private:
    bool is_keyword(std::size_t k) const {
        const auto w = s_.text(k);
        return s_.words[k].kind == Word::Kind::plain && (w == "dc" || w == "ac" || shape_of(w));
    }
    bool is_number_next() const {
        if (k_ >= s_.words.size() || is_keyword(k_)) return false;
        return s_.words[k_].kind != Word::Kind::plain || parse_number(s_.text(k_)) || scope_.parameter(s_.text(k_));
    }
    Result<double> number() {
        const WordRef text{&s_, s_.words[k_++]};
        return scope_.evaluate(text);
    }
    Error error_at(std::string_view message, std::size_t k) const {
        return bad_input(fmt::format("{}: {}", s_.text(std::size_t{0}), message), s_.location(k));
    }

    Result<void> dc() {
        if (k_ >= s_.words.size() || is_keyword(k_)) return error_at("dc must be followed by a number", k_);
        if (out_.has_dc) return error_at("dc is given twice", k_);
        const auto value = TRY(number());
        out_.dc = value, out_.has_dc = true;
        return {};
    }

    Result<void> ac() {
        out_.ac_magnitude = 1;
        for (double* to : {&out_.ac_magnitude, &out_.ac_phase}) {
            if (k_ >= s_.words.size() || is_keyword(k_)) return {};
            *to = TRY(number());
        }
        return {};
    }

    /// Reads dc, ac or a time waveform with its numbers.
    Result<void> next_item() {
        const auto w = s_.text(k_);
        if (w == "dc") return ++k_, dc();
        if (w == "ac") return ++k_, ac();
        const auto* row = shape_of(w);
        if (!row) return error_at(unknown(w), k_);
        if (out_.shape != Shape::none) return error_at(fmt::format("only one time waveform is allowed, not also '{}'", w), k_);
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
        while (k_ < s_.words.size() && !is_keyword(k_)) {
            number_words_.push_back(k_);
            out_.numbers.push_back(TRY(number()));
        }
        const auto n = out_.numbers.size();
        if (n < row.min_numbers || n > row.max_numbers)
            return error_at(fmt::format("{} has {} number{}; expected {}{}", row.name, n, n == 1 ? "" : "s", row.usage,
                                        n > row.max_numbers ? fmt::format(" with at most {}", row.max_numbers) : ""),
                            keyword);
        if (row.shape == Shape::force && n == 0) out_.numbers = {1};
        return row.shape == Shape::piecewise_linear ? check_points() : Result<void>();
    }

    /// Checks the points of a pwl.
    Result<void> check_points() {
        const auto& x = out_.numbers;
        if (x.size() % 2)
            return error_at(fmt::format("pwl has {} numbers; expected pairs of a time and a value", x.size()), number_words_.back());
        for (std::size_t k = 2; k < x.size(); k += 2)
            if (x[k] <= x[k - 2]) return error_at(fmt::format("pwl: time {:g} must be later than {:g}", x[k], x[k - 2]), number_words_[k]);
        return {};
    }

    /// Reads dc=, ac=, or td= of a pwl.
    Result<void> named(const NameValue& pair) {
        const auto name = s_.text(pair.name);
        const auto error_at_name = [&](std::string_view why) {
            return bad_input(fmt::format("{}: {}", s_.text(std::size_t{0}), why), s_.location(pair.name));
        };
        const auto value = TRY(scope_.evaluate({&s_, pair.value}));
        if (name == "dc" && !out_.has_dc)
            out_.dc = value, out_.has_dc = true;
        else if (name == "ac" && out_.ac_magnitude == 0)
            out_.ac_magnitude = value;
        else if (name == "td" && out_.shape == Shape::piecewise_linear)
            for (std::size_t k = 0; k < out_.numbers.size(); k += 2) out_.numbers[k] += value;
        else if (name == "r" && out_.shape == Shape::piecewise_linear)
            return error_at_name("a repeated pwl (r=) is not supported");
        else if (name == "td" || name == "r")
            return error_at_name(fmt::format("{}= is allowed only with pwl", name));
        else if (name == "dc" || name == "ac")
            return error_at_name(fmt::format("{} is given twice", name));
        return {};
    }
};

}  // namespace

Result<Waveform> read_waveform(const Scope& scope, const Statement& s) { return SourceReader(scope, s).read(); }

}  // namespace corpuscle::circuit
