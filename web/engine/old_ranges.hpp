#pragma once
// The algorithms and views of <ranges> that src/ uses.

#include <algorithm>
#include <functional>
#include <iterator>
#include <ranges>
#include <type_traits>
#include <utility>

namespace std::ranges {

template <class Range, class Value, class Projection = identity>
auto find(Range&& range, const Value& value, Projection projection = {}) {
    return std::find_if(std::begin(range), std::end(range), [&](auto&& x) { return std::invoke(projection, x) == value; });
}
template <class Range, class Predicate, class Projection = identity>
auto find_if(Range&& range, Predicate predicate, Projection projection = {}) {
    return std::find_if(std::begin(range), std::end(range), [&](auto&& x) { return std::invoke(predicate, std::invoke(projection, x)); });
}
template <class Range, class Predicate>
auto find_if_not(Range&& range, Predicate predicate) {
    return std::find_if_not(std::begin(range), std::end(range), [&](auto&& x) { return std::invoke(predicate, x); });
}
template <class Range, class Predicate>
bool any_of(Range&& range, Predicate predicate) {
    return ranges::find_if(range, predicate) != std::end(range);
}
template <class Range, class Predicate>
bool all_of(Range&& range, Predicate predicate) {
    return ranges::find_if_not(range, predicate) == std::end(range);
}
template <class Range, class Predicate>
bool none_of(Range&& range, Predicate predicate) {
    return !ranges::any_of(range, predicate);
}
template <class Range, class Predicate>
auto count_if(Range&& range, Predicate predicate) {
    return std::count_if(std::begin(range), std::end(range), [&](auto&& x) { return std::invoke(predicate, x); });
}
template <class Range, class Value, class Replacement>
void replace(Range&& range, const Value& value, const Replacement& replacement) {
    for (auto& x : range)
        if (x == value) x = replacement;
}
template <class Range, class Predicate, class Replacement>
void replace_if(Range&& range, Predicate predicate, const Replacement& replacement) {
    for (auto& x : range)
        if (std::invoke(predicate, x)) x = replacement;
}
template <class Range, class Compare = less, class Projection = identity>
void sort(Range&& range, Compare compare = {}, Projection projection = {}) {
    std::sort(std::begin(range), std::end(range),
              [&](auto&& a, auto&& b) { return std::invoke(compare, std::invoke(projection, a), std::invoke(projection, b)); });
}
template <class Range, class Value, class Compare = less, class Projection = identity>
auto upper_bound(Range&& range, const Value& value, Compare compare = {}, Projection projection = {}) {
    return std::upper_bound(std::begin(range), std::end(range), value,
                            [&](const Value& v, auto&& x) { return std::invoke(compare, v, std::invoke(projection, x)); });
}

/// The range under a view: a reference to a range that lives on, or a range that the view owns.
template <class Range>
class ViewBase {
    conditional_t<is_lvalue_reference_v<Range>, remove_reference_t<Range>*, Range> range_;

public:
    explicit ViewBase(Range&& range)
        : range_([&]() -> decltype(auto) {
              if constexpr (is_lvalue_reference_v<Range>)
                  return &range;
              else
                  return std::move(range);
          }()) {}
    auto& get() const {
        if constexpr (is_lvalue_reference_v<Range>)
            return *range_;
        else
            return range_;
    }
};

/// A view of the elements that `keep` accepts, each turned by `function`.
template <class Range, class Keep, class Function>
class AdaptedView {
    ViewBase<Range> base_;
    Keep keep_;
    Function function_;
    using Base = decltype(std::begin(std::declval<const ViewBase<Range>&>().get()));

public:
    AdaptedView(Range&& range, Keep keep, Function function)
        : base_(std::forward<Range>(range)), keep_(std::move(keep)), function_(std::move(function)) {}

    class iterator {
        Base at_{};
        const AdaptedView* view_ = nullptr;
        void skip() {
            while (at_ != std::end(view_->base_.get()) && !std::invoke(view_->keep_, *at_)) ++at_;
        }

    public:
        using iterator_category = forward_iterator_tag;
        using difference_type = ptrdiff_t;
        using reference = invoke_result_t<const Function&, decltype(*std::declval<const Base&>())>;
        using value_type = remove_cvref_t<reference>;
        using pointer = add_pointer_t<reference>;
        iterator() = default;
        iterator(Base at, const AdaptedView* view) : at_(at), view_(view) { skip(); }
        reference operator*() const { return std::invoke(view_->function_, *at_); }
        pointer operator->() const { return &**this; }
        iterator& operator++() {
            ++at_;
            skip();
            return *this;
        }
        iterator operator++(int) {
            auto before = *this;
            ++*this;
            return before;
        }
        bool operator==(const iterator& other) const { return at_ == other.at_; }
    };
    iterator begin() const { return {std::begin(base_.get()), this}; }
    iterator end() const { return {std::end(base_.get()), this}; }
    bool empty() const { return begin() == end(); }
    decltype(auto) front() const { return *begin(); }
};

struct KeepAll {
    template <class X>
    bool operator()(const X&) const {
        return true;
    }
};

}  // namespace std::ranges

namespace std::views {

template <class Keep, class Function>
struct Adaptor {
    Keep keep;
    Function function;
};
template <class Range, class Keep, class Function>
auto operator|(Range&& range, Adaptor<Keep, Function> adaptor) {
    return ranges::AdaptedView<Range, Keep, Function>(std::forward<Range>(range), std::move(adaptor.keep), std::move(adaptor.function));
}
template <class Keep>
auto filter(Keep keep) {
    return Adaptor<Keep, identity>{std::move(keep), {}};
}
template <class Function>
auto transform(Function function) {
    return Adaptor<ranges::KeepAll, Function>{{}, std::move(function)};
}
template <class Map>
auto keys(const Map& map) {
    return map | transform([](const auto& pair) -> const auto& { return pair.first; });
}

/// A part of a range that lives on.
template <class Iterator>
struct Part {
    Iterator first, last;
    Iterator begin() const { return first; }
    Iterator end() const { return last; }
};
struct Drop {
    ptrdiff_t count;
};
struct Take {
    ptrdiff_t count;
};
inline Drop drop(ptrdiff_t count) { return {count}; }
inline Take take(ptrdiff_t count) { return {count}; }
template <class Range>
auto operator|(Range& range, Drop drop) {
    auto at = std::begin(range);
    for (; drop.count > 0 && at != std::end(range); --drop.count) ++at;
    return Part<decltype(at)>{at, std::end(range)};
}
/// A view that is a temporary is kept by the result.
template <class Range>
struct FirstElements {
    Range range;
    ptrdiff_t count;
    auto begin() const { return range.begin(); }
    auto end() const {
        auto at = range.begin();
        for (auto left = count; left > 0 && at != range.end(); --left) ++at;
        return at;
    }
};
template <class Range>
auto operator|(Range range, Take take) {
    return FirstElements<Range>{std::move(range), take.count};
}

}  // namespace std::views
