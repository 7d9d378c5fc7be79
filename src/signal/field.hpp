#pragma once
// A parameter is said once, in its row: command line, JSON, reference, checks and defaults are made from it.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// One parameter of P: the row from which everything about it is made.
template <class P>
struct Field {
    std::string_view name;
    double P::* at;
    std::string_view unit;  ///< SI, "" for a plain number
    double low, high;       ///< the allowed range, ends included
    std::string_view sentence;
    std::string_view source = {};  ///< where the default comes from, if not from where the model does
    bool one_for_all = false;      ///< copies of an afferent share it: a choice of how they are computed or measured
};

/// Two parameters of which one must stay below the other.
template <class P>
struct Below {
    std::string_view lesser;
    double P::* less;
    std::string_view greater;
    double P::* more;
    bool or_equal = false;
};

/// A row without its struct: what lists, pages and settings need.
struct Row {
    std::string_view name, unit;
    double initial;  ///< the default
    double low, high;
    std::string_view sentence;
    std::string_view source;   ///< of the default; "": the source of the whole card
    bool one_for_all = false;  ///< copies of an afferent share it
};

/// Something with a name and parameters, as catalogues show it.
struct Card {
    std::string_view name, sentence, source;
    std::vector<Row> rows;
};

/// A parameter with the value it is to take, in SI.
struct Setting {
    std::string_view name;
    double value;
};

template <class P>
std::vector<Row> rows_of(std::span<const Field<P>> fields) {
    const P initial;
    std::vector<Row> rows;
    for (const auto& f : fields) rows.push_back({f.name, f.unit, initial.*f.at, f.low, f.high, f.sentence, f.source, f.one_for_all});
    return rows;
}

template <class M>  // a model or a stimulus: name, sentence, source, Params, fields
Card card_of() {
    return {M::name, M::sentence, M::source, rows_of<typename M::Params>(M::fields)};
}

/// Refuses a value outside the row's range: "lif-b: C_m = -1 F is outside [1e-15, 1]".
std::optional<Error> outside(std::string_view of, const Row&, double value);

/// Refuses two parameters in the wrong order: "lif-b: V_reset = 0.6 must be below V_th = 0.5".
std::optional<Error> out_of_order(std::string_view of, std::string_view lesser, double less, std::string_view greater, double more,
                                  bool or_equal);

template <class P>
std::optional<Error> out_of_order(std::string_view of, std::span<const Below<P>> orders, const P& p) {
    for (const auto& o : orders)
        if (auto wrong = out_of_order(of, o.lesser, p.*o.less, o.greater, p.*o.more, o.or_equal)) return wrong;
    return {};
}

/// The name among `names` that is closest to a mistyped one, as "; did you mean 'out'?", or "".
std::string did_you_mean(std::string_view typed, std::span<const std::string_view> names);

/// Sets what the settings name. Those that P does not have are left alone: they may belong to a partner.
template <class P>
P with(std::span<const Field<P>> fields, std::span<const Setting> settings) {
    P p;
    for (const auto& s : settings)
        for (const auto& f : fields)
            if (f.name == s.name) p.*f.at = s.value;
    return p;
}

}  // namespace corpuscle
