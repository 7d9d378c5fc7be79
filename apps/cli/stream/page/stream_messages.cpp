#include "cli/stream/page/stream_messages.hpp"

#include <cmath>

#include "page/message.hpp"

namespace corpuscle {
namespace {

using page::Json;
using page::MessageWriter;

Json describe_classes(const Innervation& skin) {
    auto classes = Json::array();
    for (std::size_t c = 0; c < skin.plan.classes.size(); ++c) {
        const auto& k = skin.plan.classes[c];
        classes.push_back({{"name", k.name},
                           {"afferent", k.afferent_name.empty() ? k.name : k.afferent_name},
                           {"first", skin.class_begin[c]},
                           {"count", skin.class_begin[c + 1] - skin.class_begin[c]}});
    }
    return classes;
}

void add_afferents(MessageWriter& out, const Innervation& skin) {
    std::vector<float> x, y;
    std::vector<std::uint8_t> classes;
    std::vector<std::uint32_t> regions;
    for (const auto& a : skin.afferents) {
        x.push_back(static_cast<float>(a.position.x)), y.push_back(static_cast<float>(a.position.y));
        classes.push_back(static_cast<std::uint8_t>(a.class_index)), regions.push_back(a.region);
    }
    out.add("x", x), out.add("y", y), out.add("class", classes), out.add("region", regions);
}

void add_sites(MessageWriter& out, const Sites& sites) {
    std::vector<float> x, y;
    for (const auto& p : sites.positions) x.push_back(static_cast<float>(p.x)), y.push_back(static_cast<float>(p.y));
    out.add("site_x", x), out.add("site_y", y), out.add("site_region", sites.region);
}

}  // namespace

std::vector<std::byte> encode_stream_greeting(const SkinStream& stream, std::int64_t force_interval) {
    const auto& skin = stream.innervation();
    const auto& plan = skin.plan;
    MessageWriter out;
    out.head = {{"event", "stream"},
                {"population", plan.name},
                {"description", plan.description},
                {"rate", stream.clock().rate()},
                {"force_rate", stream.clock().rate() / static_cast<double>(force_interval)},
                {"classes", describe_classes(skin)},
                {"regions", plan.sites.regions},
                {"site_side", std::sqrt(plan.sites.area)},
                {"units", skin.afferents.size()}};
    if (plan.is_by_channel) out.head["channels"] = plan.sites.names;
    add_afferents(out, skin);
    add_sites(out, plan.sites);
    return out.finish();
}

std::vector<std::byte> encode_frames(const FrameBatch& batch, const Clock& clock) {
    MessageWriter out;
    out.head = {{"event", "frames"}};
    if (batch.lost_frames + batch.lost_spikes > 0) out.head["lost"] = {{"frames", batch.lost_frames}, {"spikes", batch.lost_spikes}};
    std::vector<double> times;
    for (const auto frame : batch.frames) times.push_back(clock.time(frame));
    out.add("frame_time", times), out.add("touched", batch.touched), out.add("site", batch.sites), out.add("force", batch.force);
    std::vector<std::uint32_t> units;
    for (const auto& s : batch.spikes) units.push_back(s.afferent_index);
    out.add("unit", units), out.add("time", spike_times(batch.spikes, clock));
    return out.finish();
}

std::vector<std::byte> encode_notice(const ServerNotice& notice) {
    MessageWriter out;
    if (notice.error.empty())
        out.head = {{"event", "lost"}, {"messages", notice.lost_messages}, {"spikes", notice.lost_spikes}};
    else
        out.head = {{"event", "refused"}, {"error", notice.error}};
    return out.finish();
}

std::vector<std::byte> encode_stream_end(std::int64_t frames, std::int64_t spikes) {
    MessageWriter out;
    out.head = {{"event", "end"}, {"frames", frames}, {"spikes", spikes}};
    return out.finish();
}

}  // namespace corpuscle
