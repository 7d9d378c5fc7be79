#pragma once
// The state of a simulation as a list of numbers.

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace corpuscle::circuit {

/// Writes values to a list, or reads them from one. The functions take the values in one order for both. After a missing or impossible
/// number, all following values that are read are 0.
class StateArchive {
    std::vector<double>* out_ = nullptr;  // null: reads
    std::span<const double> rest_;        // the numbers that are not read yet

public:
    bool is_valid = true;  ///< no number was missing or impossible so far

    explicit StateArchive(std::vector<double>& out) : out_(&out) {}
    explicit StateArchive(std::span<const double> in) : rest_(in) {}
    bool is_reader() const { return out_ == nullptr; }
    std::size_t rest() const { return rest_.size(); }  ///< number of numbers that are not read yet

    void number(double& x) {
        if (out_) return out_->push_back(x);
        is_valid &= !rest_.empty();
        x = is_valid ? rest_.front() : 0;
        if (is_valid) rest_ = rest_.subspan(1);
    }
    /// An integer from `low` to `high`.
    template <class Integer>
    void integer(Integer& n, double low, double high) {
        auto x = static_cast<double>(n);
        number(x);
        if (out_) return;
        is_valid &= x >= low && x <= high && x == std::floor(x);
        n = is_valid ? static_cast<Integer>(x) : Integer{};
    }
    void numbers(std::vector<double>& all, std::size_t count) {
        all.resize(count);
        for (double& x : all) number(x);
    }
};

inline constexpr double max_exact_integer = 0x1p53;  ///< up to this, a double represents every integer

}  // namespace corpuscle::circuit
