#include "circuit/schematic/svg_text.hpp"

#include "circuit/schematic/shape/symbol_paths.hpp"

namespace corpuscle::circuit::schematic {
namespace {

constexpr int picture_margin = 12;

// A page that shows the SVG inline may set the variables and the colour; as an image it follows the colour scheme of the system.
constexpr std::string_view style =
    ".schematic{color:var(--schematic-ink,#1a1a1a);font:10px ui-monospace,'DejaVu Sans Mono',Menlo,Consolas,monospace}"
    ".schematic path,.schematic .outline{fill:none;stroke:currentColor;stroke-width:1.2;stroke-linecap:round;stroke-linejoin:round}"
    ".schematic .solid{fill:currentColor;stroke:none}"
    ".schematic text{fill:currentColor}"
    ".schematic .name{font-weight:bold}"
    ".schematic .type,.schematic .pin{fill:var(--schematic-quiet,#666)}"
    ".schematic .hit{fill:transparent;stroke:none}"
    ".schematic .block .outline{fill:var(--schematic-fill,transparent)}"
    ".schematic .net path{stroke:var(--schematic-wire,#1f4e9c)}"
    ".schematic .net circle{fill:var(--schematic-wire,#1f4e9c)}"
    ".schematic .label{fill:var(--schematic-label,#1f4e9c)}"
    ".schematic .port path{stroke:var(--schematic-port,#a03010)}"
    "@media(prefers-color-scheme:dark){.schematic{color:var(--schematic-ink,#e6e6e6)}"
    ".schematic .type,.schematic .pin{fill:var(--schematic-quiet,#a0a0a0)}"
    ".schematic .net path{stroke:var(--schematic-wire,#7fb0ff)}"
    ".schematic .net circle{fill:var(--schematic-wire,#7fb0ff)}"
    ".schematic .label{fill:var(--schematic-label,#7fb0ff)}"
    ".schematic .port path{stroke:var(--schematic-port,#ff9a70)}}";

class SvgWriter {
    const Drawing& drawing_;
    std::string out_;

    template <class... Arguments>
    void add(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
        fmt::format_to(std::back_inserter(out_), text, std::forward<Arguments>(arguments)...);
    }

    void add_text(const Text& text, std::string_view css_class) {
        const char* anchor = text.anchor == Text::Anchor::middle ? " text-anchor=\"middle\""
                             : text.anchor == Text::Anchor::end  ? " text-anchor=\"end\""
                                                                 : "";
        if (!text.text.empty())
            add("<text class=\"{}\" x=\"{}\" y=\"{}\"{}>{}</text>", css_class, text.at.x, text.at.y, anchor, escaped(text.text));
    }
    static std::string_view class_of(Text::Kind kind) {
        return kind == Text::Kind::name   ? "name"
               : kind == Text::Kind::type ? "type"
               : kind == Text::Kind::pin  ? "pin"
               : kind == Text::Kind::net  ? "label"
                                          : "value";
    }

    std::string description_of(const Part& part) const {
        std::string text = part.name;
        for (const auto& value : part.texts) text += (text == part.name ? ": " : ", ") + value;
        if (!part.type.empty()) text += ", " + part.type;
        if (part.symbol == Symbol::block) text = fmt::format("{}: {}", part.name, part.type);
        return text;
    }

    void add_part(const PlacedPart& placed) {
        const auto& part = drawing_.level.parts[placed.part];
        if (part.symbol == Symbol::port) return;  // drawn with its net
        const bool is_block = part.symbol == Symbol::block, is_instance = is_block && !part.is_device_box;
        add("<g class=\"{0}\" data-{0}=\"{1}\" transform=\"translate({2} {3})\"><title>{4}</title>", is_instance ? "block" : "device",
            escaped(part.path), placed.at.x, placed.at.y, escaped(description_of(part)));
        const auto& box = placed.shape.outline;
        if (!box.is_empty())
            add("<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}/>", is_block ? "outline" : "hit", box.left, box.top,
                box.right - box.left, box.bottom - box.top, is_block ? " rx=\"3\"" : "");
        is_block ? add_leads(placed) : add_symbol(part, placed.orientation);
        for (const auto& text : placed.shape.texts)
            if (text.kind != Text::Kind::net) add_text(text, class_of(text.kind));
        out_ += "</g>\n";
    }
    void add_leads(const PlacedPart& placed) {
        out_ += "<path d=\"";
        for (const auto& pin : placed.shape.pins) {
            const auto u = unit_of(pin.out);
            add("M{} {}l{} {}", pin.at.x, pin.at.y, -10 * u.x, -10 * u.y);
        }
        out_ += "\"/>";
    }
    void add_symbol(const Part& part, Orientation o) {
        const auto symbol = symbol_path(part);
        if (symbol.lines.empty()) return;
        const auto t = map_of(o);
        const bool is_upright = t.xx == 1 && t.yy == 1;
        const auto turn = is_upright ? "" : fmt::format(" transform=\"matrix({} {} {} {} 0 0)\"", t.xx, t.yx, t.xy, t.yy);
        add("<path d=\"{}\"{}/>", symbol.lines, turn);
        if (!symbol.solid.empty()) add("<path class=\"solid\" d=\"{}\"{}/>", symbol.solid, turn);
        if (symbol.signs.empty()) return;
        out_ += "<path d=\"";
        for (const auto& sign : symbol.signs) {
            const auto at = t(sign.at);
            add("M{} {}h6", at.x - 3, at.y);
            if (sign.is_plus) add("M{} {}v6", at.x, at.y - 3);
        }
        out_ += "\"/>";
    }

    /// The marks at the pins of a net that no wire joins.
    std::string marks_of(const PlacedPart& placed, const ShapePin& pin) const {
        const auto p = placed.at + pin.at, u = unit_of(pin.out);
        const auto bar = [&](int far, int half) {
            return fmt::format("M{} {}l{} {}", p.x + far * u.x - half * u.y, p.y + far * u.y - half * u.x, 2 * half * u.y, 2 * half * u.x);
        };
        if (pin.connection == Connection::ground)
            return fmt::format("M{} {}l{} {}", p.x, p.y, 6 * u.x, 6 * u.y) + bar(6, 8) + bar(9, 5) + bar(12, 2);
        if (pin.connection == Connection::supply) return fmt::format("M{} {}l{} {}", p.x, p.y, 8 * u.x, 8 * u.y) + bar(8, 8);
        return "";
    }
    static std::string flag_of(const PlacedPart& placed) {
        const int side = placed.orientation.is_mirrored ? -1 : 1;
        return fmt::format("M{} {}h{}l{} 5l{} 5h{}z", placed.at.x - 8 * side, placed.at.y - 5, 12 * side, 6 * side, -6 * side, -12 * side);
    }

    void add_net(std::size_t number, const std::vector<std::pair<std::size_t, std::size_t>>& pins) {
        const auto& net = drawing_.level.nets[number];
        const auto& drawn = drawing_.nets[number];
        add("<g class=\"net\" data-net=\"{}\"><title>{}</title>", escaped(net.path), escaped(net.name));
        std::string path;
        for (const auto& wire : drawn.wires) path += fmt::format("M{} {}L{} {}", wire.from.x, wire.from.y, wire.to.x, wire.to.y);
        for (const auto& [p, k] : pins) {
            const auto& placed = drawing_.parts[p];
            if (drawing_.level.parts[placed.part].symbol != Symbol::port) path += marks_of(placed, placed.shape.pins[k]);
        }
        if (!path.empty()) add("<path d=\"{}\"/>", path);
        for (const auto& point : drawn.junctions) add("<circle cx=\"{}\" cy=\"{}\" r=\"2.5\"/>", point.x, point.y);
        for (const auto& name : drawn.names) add_text(name, "label");
        for (const auto& [p, k] : pins) add_labels(drawing_.parts[p], k);
        out_ += "</g>\n";
    }
    void add_labels(const PlacedPart& placed, std::size_t pin) {
        if (drawing_.level.parts[placed.part].symbol == Symbol::port) {
            add("<g class=\"port\"><path d=\"{}\"/></g>", flag_of(placed));
        }
        int count = 0;  // labels are in the order of their pins
        for (std::size_t k = 0; k < pin; ++k) {
            const auto connection = placed.shape.pins[k].connection;
            count += connection == Connection::label || connection == Connection::supply ? 1 : 0;
        }
        const auto own = placed.shape.pins[pin].connection;
        const bool has_label =
            own == Connection::label || own == Connection::supply || drawing_.level.parts[placed.part].symbol == Symbol::port;
        if (!has_label) return;
        for (auto text : placed.shape.texts)
            if (text.kind == Text::Kind::net && count-- == 0) {
                text.at = text.at + placed.at;
                add_text(text, "label");
            }
    }

public:
    explicit SvgWriter(const Drawing& drawing) : drawing_(drawing) {}
    std::string run() {
        const auto& e = drawing_.extent;
        const auto& level = drawing_.level;
        const auto title = level.path.empty()               ? level.title
                           : level.path == level.subcircuit ? level.path  // a definition
                                                            : fmt::format("{}: {}", level.path, level.subcircuit);
        add("<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"schematic\" role=\"img\" viewBox=\"{} {} {} {}\">\n",
            e.left - picture_margin, e.top - picture_margin, e.right - e.left + 2 * picture_margin, e.bottom - e.top + 2 * picture_margin);
        std::size_t devices = 0, blocks = 0;
        const auto counted = [](std::size_t count, const char* noun) { return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s"); };
        for (const auto& part : level.parts) ++(part.symbol == Symbol::block && !part.is_device_box ? blocks : devices);
        add("<title>{}</title>\n<desc>Schematic with {}, {} and {}</desc>\n<style>{}</style>\n", escaped(title),
            counted(devices - level.ports.size(), "device"), counted(blocks, "block"), counted(level.nets.size(), "net"), style);
        std::vector<std::vector<std::pair<std::size_t, std::size_t>>> pins(level.nets.size());
        for (std::size_t p = 0; p < drawing_.parts.size(); ++p)
            for (std::size_t k = 0; k < drawing_.parts[p].shape.pins.size(); ++k)
                pins[static_cast<std::size_t>(drawing_.parts[p].shape.pins[k].net)].emplace_back(p, k);
        for (std::size_t net = 0; net < level.nets.size(); ++net)
            if (!pins[net].empty()) add_net(net, pins[net]);
        for (const auto& placed : drawing_.parts) add_part(placed);
        out_ += "</svg>\n";
        return std::move(out_);
    }
};

}  // namespace

std::string svg_of(const Drawing& drawing) { return SvgWriter(drawing).run(); }

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else if (c == '"')
            out += "&quot;";
        else if (c == '\'')
            out += "&#39;";
        else
            out += byte < 0x20 || byte == 0x7F ? '?' : c;
    }
    return out;
}

}  // namespace corpuscle::circuit::schematic
