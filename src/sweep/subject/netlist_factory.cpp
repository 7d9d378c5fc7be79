#include "sweep/subject/netlist_factory.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>

#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/embedded_files.hpp"
#include "core/text/input_files.hpp"
#include "run/netlist/netlist_directives.hpp"

namespace corpuscle::sweeps {
namespace {

namespace fs = std::filesystem;
using circuit::Netlist;

constexpr std::size_t max_bytes = std::size_t{64} << 20;  // of one netlist file

bool is_embedded_file(std::string_view path) {
    const auto all = embedded_files();
    return std::find(all.begin(), all.end(), path) != all.end();
}

/// Reads a netlist file. Accepts only regular files: pipes could not be read again in another run.
Result<std::string> read_netlist_file(const fs::path& path, const std::string& name) {
    std::error_code status;
    if (fs::exists(path, status) && !fs::is_regular_file(path, status))
        return bad_input("this is not a regular file; save its content to a file", {name});
    auto text = read_entire_input(path.string(), max_bytes, "netlist");
    return text ? std::move(text) : Error{text.error().code, text.error().message, {name}};
}

/// A temperature in degrees Celsius. Accepts "85" and "85C".
Result<double> temperature_of(const LocatedText& spec) {
    auto text = trimmed(spec.text);
    for (const std::string_view unit : {"degC", "\u00b0C", "C"})
        if (text.ends_with(unit)) {
            text.remove_suffix(unit.size());
            break;
        }
    const auto value = circuit::parse_number_with_unit(text);
    if (!value || !value->unit.empty())
        return bad_input(fmt::format("'{}' is not a temperature; write degrees Celsius, such as 85", spec.text));
    return value->value;
}

/// A number; a unit after it is ignored.
Result<double> any_number(const LocatedText& spec) {
    const auto value = circuit::parse_number_with_unit(spec.text);
    return value ? Result<double>(value->value) : value.error();
}

}  // namespace

/// The source files, as they were first read, so that changes of a file during the sweep have no effect.
struct NetlistFactory::Files {
    std::recursive_mutex mutex;                              // a netlist includes other files
    std::vector<std::pair<std::string, std::string>> texts;  // path and text
    std::map<std::string, Netlist> by_corner;                // parsed netlists
};

Result<NetlistFactory> NetlistFactory::of(const LocatedText& name_or_path, const std::string& folder, const std::string& directives) {
    NetlistFactory out;
    out.name_ = out.file_ = name_or_path.text, out.folder_ = folder, out.directives_ = directives, out.files_ = std::make_shared<Files>();
    std::error_code status;
    if (const auto* embedded = circuit::find_embedded_netlist(name_or_path.text)) {
        out.file_ = embedded->file, out.name_ = embedded->name, out.is_embedded_ = true;
    } else if (const fs::path path = name_or_path.text; path.is_absolute()) {  // results must not contain absolute paths
        out.folder_ = path.parent_path().string(), out.name_ = out.file_ = path.filename().string();
    }
    if (!out.is_embedded_ && !fs::exists(fs::path(out.folder_) / out.file_, status)) {
        std::vector<std::string_view> known;
        for (const auto file : embedded_files())
            if (file.ends_with(".cir")) known.push_back(file);
        for (const auto& c : circuit::embedded_netlists) known.push_back(c.name);
        if (!is_embedded_file(out.file_))
            return name_or_path.error_here(
                fmt::format("there is no netlist '{}' in the folder of the sweep file and no embedded one of this name{}",
                            name_or_path.text, did_you_mean(name_or_path.text, known)));
        out.is_embedded_ = true;
    }
    auto opened = TRY(out.open(""));  // finds errors in the netlist
    return out;
}

Result<std::string> NetlistFactory::text_of(const std::string& path) const {
    const std::lock_guard lock(files_->mutex);
    for (const auto& [name, text] : files_->texts)
        if (name == path) return text;
    std::error_code status;
    const auto full_path = fs::path(folder_) / path;
    const auto card = is_embedded_ || fs::exists(full_path, status) ? "" : embedded_card_of(path);
    auto text = is_embedded_ ? embedded_text(path) : !card.empty() ? embedded_text(card) : read_netlist_file(full_path, path);
    if (!text) return text;
    files_->texts.emplace_back(path, *text);
    return text;
}

Result<Netlist> NetlistFactory::open(const std::string& corner) const {
    const std::lock_guard lock(files_->mutex);
    if (const auto at = files_->by_corner.find(corner); at != files_->by_corner.end()) return at->second;
    auto text = TRY(text_of(file_));
    if (!directives_.empty()) text = with_directives(text, directives_);
    auto netlist = TRY(Netlist::parse(std::move(text), file_, [this](const std::string& path) { return text_of(path); }, corner));
    return files_->by_corner.emplace(corner, std::move(netlist)).first->second;
}

ParameterOverride NetlistFactory::override_of(const std::string& name, std::string value) const {
    // "supply" is the .param and not a device, as with --supply; such an override has no target.
    return {equal_ignoring_case(name, "supply") ? "" : file_, name, std::move(value), name};
}

Result<Netlist> NetlistFactory::with_overrides(std::span<const ParameterOverride> overrides) const {
    auto applied = TRY(circuit::apply_overrides([this](const std::string& corner) { return open(corner); }, file_, overrides));
    if (saved_curves_.empty()) return std::move(applied.result);
    auto changes = applied.result.overrides();
    changes.replaces_saved = true, changes.saved = saved_curves_;
    return applied.result.with_overrides(std::move(changes));
}

Result<void> NetlistFactory::set(const LocatedSetting& setting) {
    auto extended = overrides_;
    extended.push_back(override_of(setting.name, setting.value.text));
    if (const auto ok = with_overrides(extended); !ok)
        return ok.error().location.line > 0 ? ok.error() : setting.value.error_here(ok.error().message);
    overrides_ = std::move(extended);
    return {};
}

Result<VariedQuantity> NetlistFactory::find_quantity(const LocatedText& quantity) {
    const auto check = [this, name = quantity.text](const std::string& value) -> Result<void> {
        auto extended = overrides_;
        extended.push_back(override_of(name, value));
        const auto ok = with_overrides(extended);
        return ok ? Result<void>() : ok.error();
    };
    VariedQuantity out{{quantity.text, "", ""}};
    out.parse = any_number, out.check = check, out.allows_labels = true;
    out.vary = [this, name = quantity.text](std::size_t axis, const auto& labels) { varied_.push_back({name, axis, labels}); };
    const auto lowercase = lower(quantity.text);
    if (lowercase == "corner") {
        out.labels_only = true, out.column.description = "process corner";
        return out;
    }
    const auto circuit = TRY(TRY(nominal()).elaborate());
    if (lowercase == "temp") {
        out.parse = temperature_of, out.nominal = circuit.temperature, out.allows_labels = false;
        out.column.unit = "degC", out.column.description = "temperature";
    } else if (const auto at = circuit.parameters.find(lowercase); at != circuit.parameters.end()) {
        out.nominal = at->second, out.allows_labels = false;
        out.column.description = fmt::format(".param {} of {}", lowercase, file_);
    } else {
        out.column.description = fmt::format("device parameter in {}", file_);
        // Only errors about the name are reported here; others may be due to the value 1.
        if (const auto ok = check("1");
            !ok && (ok.error().message.find(" has no ") != std::string::npos || ok.error().message.find("may be") != std::string::npos))
            return quantity.error_here(ok.error().message);
    }
    return out;
}

Result<Netlist> NetlistFactory::at(std::span<const double> values) const {
    auto overrides = overrides_;
    for (const auto& v : varied_)
        overrides.push_back(
            override_of(v.name, v.labels.empty() ? fmt::format("{}", values[v.axis]) : v.labels[static_cast<std::size_t>(values[v.axis])]));
    return with_overrides(overrides);
}

std::vector<double> NetlistFactory::netlist_values(std::span<const double> values) const {
    std::vector<double> out;
    for (const auto& v : varied_) out.push_back(values[v.axis]);
    return out;
}

std::vector<MetadataText> NetlistFactory::metadata() const {
    const std::lock_guard lock(files_->mutex);
    std::vector<MetadataText> out;
    for (const auto& [name, text] : files_->texts) {
        const fs::path path = name;
        out.push_back(
            {fmt::format("{} {}", name == file_ ? "netlist" : "file", path.is_absolute() ? path.filename().string() : name), text});
    }
    return out;
}

bool same_devices(const circuit::Circuit& a, const circuit::Circuit& b) {
    if (a.nodes != b.nodes || a.elements.size() != b.elements.size()) return false;
    for (std::size_t k = 0; k < a.elements.size(); ++k) {
        const auto &x = a.elements[k], &y = b.elements[k];
        const auto type = [](const circuit::Circuit& c, const circuit::Element& e) {
            return e.model < 0 ? std::string_view() : std::string_view(c.models[static_cast<std::size_t>(e.model)].type);
        };
        if (x.name != y.name || x.letter != y.letter || x.nodes != y.nodes || x.control_source != y.control_source ||
            x.inductors != y.inductors || type(a, x) != type(b, y))
            return false;
    }
    return true;
}

}  // namespace corpuscle::sweeps
