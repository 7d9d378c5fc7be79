#include "circuit/variant/embedded_netlists.hpp"

#include "core/text/ascii_text.hpp"
#include "core/text/embedded_files.hpp"

namespace corpuscle::circuit {
const EmbeddedNetlist* find_embedded_netlist(std::string_view name) {
    for (const auto& c : embedded_netlists)
        if (equal_ignoring_case(c.name, name)) return &c;
    return nullptr;
}

Result<Netlist> open_netlist(const std::string& name_or_path, const std::string& corner) {
    const auto* embedded = find_embedded_netlist(name_or_path);
    if (embedded == nullptr) return Netlist::read(name_or_path, corner);
    auto text = TRY(embedded_text(std::string(embedded->file)));
    return parse_embedded(std::move(text), std::string(embedded->file), corner);
}

Result<Netlist> parse_embedded(std::string text, std::string file, const std::string& corner) {
    return Netlist::parse(std::move(text), std::move(file), embedded_text, corner);
}

}  // namespace corpuscle::circuit
