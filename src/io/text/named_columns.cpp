#include "io/text/named_columns.hpp"

#include "core/text/ascii_text.hpp"
#include "io/table/heading.hpp"

namespace corpuscle {

Result<bool> NamedColumns::read_header() {
    if (!TRY(next())) return false;
    dialect_ = Dialect::detect(line_);
    dialect_.split(line_, fields_);
    for (const auto& field : fields_) headings_.push_back(parse_heading(field));
    return true;
}

Result<bool> NamedColumns::next() {
    while (TRY(lines_.next(line_)))
        if (const auto text = trimmed(line_); !text.empty() && text.front() != '#' && text.front() != '%')
            return dialect_.split(line_, fields_), true;
    return false;
}

std::optional<std::size_t> NamedColumns::find(std::initializer_list<std::string_view> names) const {
    std::optional<std::size_t> out;
    for (std::size_t f = 0; f < headings_.size(); ++f)
        if (std::find(names.begin(), names.end(), lower(headings_[f].name)) != names.end()) out = f;
    return out;
}

Error NamedColumns::error_at(std::string message, std::size_t field) const {
    const long column = field < fields_.size() ? fields_[field].data() - line_.data() + 1 : 0;
    return bad_input(std::move(message), {lines_.path(), lines_.line_number(), column});
}

}  // namespace corpuscle
