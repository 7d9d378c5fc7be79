// Fig. 45: the layout of the trapezoidal arrays, drawn by one rule.

#include <fmt/format.h>
#include <numeric>

#include "study/layout.hpp"
#include "study/studies.hpp"

namespace corpuscle::studies::fig45 {

Result<Outcome> work(const StudyOptions&) {
    const auto ours = arrays_of(trapezoids);
    if (!ours) return ours.error();
    Outcome out;
    double printed_sum = 0, sum = 0;
    for (const auto& a : *ours) {
        out.claim(fmt::format("{}: total area", a.printed->name), 1e12 * a.A_T, "um^2")
            .printed_as(a.printed->A_T, "table 13, of what fig. 45 shows");
        out.claim(fmt::format("{}: active area by its channels", a.printed->name),
                  1e12 * a.W * std::accumulate(a.lengths.begin(), a.lengths.end(), 0.0), "um^2")
            .printed_as(a.printed->A, "table 13");
        printed_sum += a.printed->A_T, sum += 1e12 * a.A_T;
    }
    out.claim("All together", sum, "um^2").held_to(printed_sum, "table 13");
    out.plots.push_back(layout_of(*ours, "Channels and total areas of E, F, G1, G2, G3, from the left")
                            .shape("polysilicon and diffusion of each array in its rectangle; the figure itself is lost"));
    out.note(
        "Rows and columns are those by which the printed total areas come out; what lies about the channels and between them is one rule "
        "for all. F's two channels stand closer than units do: by the same rule its rectangle is longer than printed.");
    return out;
}

const Study study{"fig45", "Layout of the trapezoidal arrays",
                  "Channels in rows and columns, and the rectangles that are counted. Thesis B.2, fig. 45", work};

}  // namespace corpuscle::studies::fig45
