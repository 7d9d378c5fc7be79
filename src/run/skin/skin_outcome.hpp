#pragma once
// The outcome of a run of a skin: its summary, notes and warnings, the same for the command line and for programs.

#include "run/skin/skin_scene.hpp"
#include "run/summary/silent_afferents.hpp"
#include "run/summary/skin_summary.hpp"

namespace corpuscle {

/// How the user described the run, for remedies that can be typed.
struct SkinRunWords {
    std::string population;  ///< "hand", a path
    bool has_unit = false;   ///< the unit of the recording was given
};

class SkinOutcome {
public:
    std::shared_ptr<const Innervation> innervation;  ///< to which the summary refers
    RespondOptions options;
    SkinSummary summary = {};
    SkinRunNotes notes = {};  ///< complete after finish()

    SkinOutcome(const SkinScene&, const RespondOptions&);
    /// The sinks that the run must have.
    std::vector<Sink*> sinks() { return {&summary, &silence_}; }
    /// Adds notes and warnings. Call it after the run.
    void finish(const ForceSource&, const SkinScene&, const RunStats&, const SkinRunWords&);
    /// The document of summary.json, without its list of files.
    nlohmann::ordered_json document() const;

private:
    SilenceDetector silence_ = {};

    const SkinPlan& plan() const { return innervation->plan; }
    void add_force_notes(const ForceSource&, const SkinScene&);
    void add_response_warnings(const ForceSource&);
    std::string silence_text(const SilentClass&) const;
    void add_silence_notes(const ForceSource&, bool has_contact, const SkinRunWords&);
    void add_rate_warnings(double T);
};

}  // namespace corpuscle
