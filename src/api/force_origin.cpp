#include "api/force_origin.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

/// A number; NaN is null in JSON.
double number_of(const Json& value) { return value.is_null() ? std::nan("") : value.get<double>(); }

Json document_of(const Channel& c) {
    Json out = {{"id", c.id}, {"name", c.name}};
    if (c.position) out["position"] = {c.position->x, c.position->y, c.position->z};
    return out;
}

Channel channel_of(const Json& document) {
    Channel out{document.at("id"), document.at("name")};
    if (document.contains("position")) {
        const auto& at = document["position"];
        out.position = Position{number_of(at.at(0)), number_of(at.at(1)), number_of(at.at(2))};
    }
    return out;
}

ForceOrigin origin_of(const Json& document) {
    ForceOrigin out;
    for (const auto& c : document.at("channels")) out.channels.push_back(channel_of(c));
    for (const auto& p : document.at("phases")) out.phases.push_back({p.at(0), number_of(p.at(1)), number_of(p.at(2))});
    out.cycle_frequency = number_of(document.at("cycle_frequency"));
    document.at("description").get_to(out.description);
    for (const auto& m : document.at("metadata")) out.metadata.push_back({m.at(0), number_of(m.at(1)), m.at(2)});
    document.at("notes").get_to(out.notes);
    for (const auto& m : document.at("metrics")) {
        const auto channel = m.at(0).get<std::uint32_t>();
        if (channel >= out.channels.size()) throw InputError("the saved origin of a force has a metric of a channel that it does not have");
        const auto &name = out.names.emplace_back(m.at(1)), &unit = out.names.emplace_back(m.at(3));
        out.quality.metrics.push_back({channel, name, number_of(m.at(2)), unit});
    }
    document.at("descriptions").get_to(out.quality.descriptions);
    document.at("warnings").get_to(out.quality.warnings);
    document.at("has_unit").get_to(out.has_unit);
    return out;
}

}  // namespace

std::string save_origin(const ForceOrigin& origin) {
    Json channels = Json::array(), phases = Json::array(), metadata = Json::array(), metrics = Json::array();
    for (const auto& c : origin.channels) channels.push_back(document_of(c));
    for (const auto& p : origin.phases) phases.push_back({p.name, p.from, p.to});
    for (const auto& m : origin.metadata) metadata.push_back({m.name, m.value, m.unit});
    for (const auto& m : origin.quality.metrics) metrics.push_back({m.channel, m.name, m.value, m.unit});
    const Json document = {{"channels", channels},
                           {"phases", phases},
                           {"cycle_frequency", origin.cycle_frequency},
                           {"description", origin.description},
                           {"metadata", metadata},
                           {"notes", origin.notes},
                           {"metrics", metrics},
                           {"descriptions", origin.quality.descriptions},
                           {"warnings", origin.quality.warnings},
                           {"has_unit", origin.has_unit}};
    return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::shared_ptr<const ForceOrigin> load_origin(const std::string& text) {
    try {
        return std::make_shared<const ForceOrigin>(origin_of(Json::parse(text)));
    } catch (const Json::exception& error) {
        throw InputError(std::string("the saved origin of a force cannot be read: ") + error.what());
    }
}

}  // namespace corpuscle
