#include "circuit/solve/matrix.hpp"

#include <klu.h>

#include <algorithm>
#include <optional>
#include <type_traits>

#include "circuit/solve/elimination.hpp"

namespace corpuscle::circuit {

Pattern::Pattern(int size, std::vector<std::pair<int, int>> entries) : size_(size), begin_(static_cast<std::size_t>(size) + 1) {
    std::sort(entries.begin(), entries.end(), [](auto a, auto b) { return std::pair(a.second, a.first) < std::pair(b.second, b.first); });
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    for (const auto& [row, column] : entries) rows_.push_back(row), ++begin_[static_cast<std::size_t>(column) + 1];
    for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
}

std::size_t Pattern::place(int row, int column) const {
    const auto from = rows_.begin() + begin_[static_cast<std::size_t>(column)],
               to = rows_.begin() + begin_[static_cast<std::size_t>(column) + 1];
    return static_cast<std::size_t>(std::lower_bound(from, to, row) - rows_.begin());
}

template <class T>
struct Solver<T>::Held {
    static constexpr bool is_complex = !std::is_same_v<T, double>;
    const Pattern& pattern;
    int size;
    std::vector<int> begin, rows;
    klu_common common;
    klu_symbolic* symbolic;
    klu_numeric* numeric = nullptr;
    std::optional<Elimination> list;
    bool by_list = false;  // the last matrix went along the list
    long strayed = 0;

    explicit Held(const Pattern& p)
        : pattern(p), size(p.size()), begin(p.begin().begin(), p.begin().end()), rows(p.rows().begin(), p.rows().end()) {
        klu_defaults(&common);
        symbolic = klu_analyze(size, begin.data(), rows.data(), &common);
    }
    ~Held() {
        forget();
        klu_free_symbolic(&symbolic, &common);
    }
    void forget() {
        if (numeric == nullptr) return;
        if constexpr (is_complex)
            klu_z_free_numeric(&numeric, &common);
        else
            klu_free_numeric(&numeric, &common);
        numeric = nullptr;
    }
    bool again(double* values) {
        int ok = 0;
        if constexpr (is_complex)
            ok = klu_z_refactor(begin.data(), rows.data(), values, symbolic, numeric, &common) && klu_z_rcond(symbolic, numeric, &common);
        else
            ok = klu_refactor(begin.data(), rows.data(), values, symbolic, numeric, &common) && klu_rcond(symbolic, numeric, &common);
        return ok && common.status == KLU_OK && common.rcond > 1e-13;  // else other pivots may be better
    }
    bool anew(double* values) {
        forget();
        if constexpr (is_complex)
            numeric = klu_z_factor(begin.data(), rows.data(), values, symbolic, &common);
        else
            numeric = klu_factor(begin.data(), rows.data(), values, symbolic, &common);
        return numeric != nullptr && common.status == KLU_OK;
    }
};

template <class T>
Solver<T>::Solver(const Pattern& p) : held_(std::make_unique<Held>(p)) {}
template <class T>
Solver<T>::~Solver() = default;
template <class T>
Solver<T>::Solver(Solver&&) noexcept = default;

template <class T>
bool Solver<T>::factor(std::span<const T> values) {
    auto* numbers = reinterpret_cast<double*>(const_cast<T*>(values.data()));  // KLU takes no const, and changes nothing
    if (held_->symbolic == nullptr) return false;
    if constexpr (!Held::is_complex) {
        held_->by_list = held_->list && held_->list->factor(values);
        if (held_->by_list) return true;
        if (held_->list) return factor_anew(values);  // and not along pivots that depend on which matrices went before
    }
    // Beside a list the last pivots are not tried: an answer is to depend on its matrix alone, not on those before.
    return (held_->numeric != nullptr && !held_->list && held_->again(numbers)) || held_->anew(numbers);
}

template <class T>
bool Solver<T>::factor_anew(std::span<const T> values) {
    held_->by_list = false;
    held_->strayed += held_->list.has_value();
    return held_->anew(reinterpret_cast<double*>(const_cast<T*>(values.data())));
}

template <class T>
double Solver<T>::growth() const {
    return held_->by_list ? held_->list->growth() : 0;
}

template <class T>
void Solver<T>::settle(std::span<const T> values) {
    if constexpr (!Held::is_complex) {
        constexpr int too_large = 3000;  // unknowns: the list's pattern is worked out in a square of bytes
        auto* numbers = const_cast<double*>(values.data());
        if (held_->symbolic == nullptr || held_->size > too_large || !held_->anew(numbers)) return;
        std::vector<int> rows(static_cast<std::size_t>(held_->size)), columns(rows.size());
        klu_extract(held_->numeric, held_->symbolic, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
                    rows.data(), columns.data(), nullptr, nullptr, &held_->common);
        held_->list.emplace(held_->pattern, rows, columns, values);
        held_->strayed = 0;
    }
    (void)values;
}

template <class T>
const Elimination* Solver<T>::list() const {
    return held_->list ? &*held_->list : nullptr;
}

template <class T>
long Solver<T>::strayed() const {
    return held_->strayed;
}

template <class T>
Singular Solver<T>::where() const {
    return {held_->symbolic == nullptr || held_->common.singular_col >= held_->size ? -1 : held_->common.singular_col};
}

template <class T>
void Solver<T>::solve(std::span<T> b) const {
    auto* numbers = reinterpret_cast<double*>(b.data());
    if constexpr (!Held::is_complex)
        if (held_->by_list) return held_->list->solve(b);
    if constexpr (Held::is_complex)
        klu_z_solve(held_->symbolic, held_->numeric, held_->size, 1, numbers, &held_->common);
    else
        klu_solve(held_->symbolic, held_->numeric, held_->size, 1, numbers, &held_->common);
}

template <class T>
void Solver<T>::solve_transposed(std::span<T> b) const {
    auto* numbers = reinterpret_cast<double*>(b.data());
    if constexpr (Held::is_complex)
        klu_z_tsolve(held_->symbolic, held_->numeric, held_->size, 1, numbers, 0, &held_->common);
    else
        klu_tsolve(held_->symbolic, held_->numeric, held_->size, 1, numbers, &held_->common);
}

template class Solver<double>;
template class Solver<std::complex<double>>;

}  // namespace corpuscle::circuit
