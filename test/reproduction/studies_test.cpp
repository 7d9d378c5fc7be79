#include "reproduction/claims/studies.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "reproduction/claims/study_document.hpp"
#include "reproduction/claims/verdict_counts.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

StudyResult run(std::string_view name) {
    const auto study = std::find_if(all_studies().begin(), all_studies().end(), [&](const Study* s) { return s->name == name; });
    return test::value_or_throw((*study)->run({}));
}

const Claim& claim(const StudyResult& outcome, const std::string& what) {
    for (const auto& c : outcome.claims)
        if (c.label == what) return c;
    throw std::runtime_error("no claim '" + what + "'");
}

void check(const Study& study, const StudyResult& outcome) {
    EXPECT_FALSE(outcome.claims.empty()) << study.name;
    for (const auto& c : outcome.claims) {
        EXPECT_TRUE(std::isfinite(c.computed) || !c.note.empty()) << study.name << ": " << c.label;
        EXPECT_TRUE((!c.has_allowed_range() && std::isnan(c.published)) || !c.source.empty())
            << study.name << ": " << c.label << " has a published value but no source";
        EXPECT_TRUE(!c.needs_explanation() || !c.note.empty()) << study.name << ": " << c.label << " has no note on why it differs";
        EXPECT_TRUE(c.kind || *c.verdict() == 0) << study.name << ": " << c.label << " has no kind";
    }
    for (const auto& p : outcome.plots) {
        EXPECT_FALSE(p.series.empty()) << study.name << ": " << p.title;
        for (const auto& series : p.series)
            EXPECT_TRUE(series.style == StudyPlot::Style::raster || (series.x.size() == series.y.size() && !series.x.empty()))
                << study.name << ": " << p.title << ", " << series.name;
    }
}

/// Number of deviations without a known cause, which say so.
int count_unexplained(std::span<const StudyResult> outcomes) {
    int out = 0;
    for (const auto& outcome : outcomes)
        for (const auto& c : outcome.claims) {
            if (!c.needs_explanation()) continue;
            EXPECT_EQ(c.note.find("unknown"), std::string::npos) << c.label << ": say \"not known\"";
            out += c.note.find("not known") != std::string::npos;
        }
    return out;
}

/// The text with each run of spaces and line ends as one space.
std::string on_one_line(const std::string& text) {
    std::string out;
    for (const char c : text)
        if (c != ' ' && c != '\n')
            out += c;
        else if (!out.ends_with(' '))
            out += ' ';
    return out;
}

TEST(Studies, GiveTheTextOfTheReproductionPage) {
    double last = 0;
    const auto outcomes = run_studies(all_studies(), {[&](double fraction) {
                                          EXPECT_GE(fraction, last);
                                          EXPECT_LE(fraction, 1 + 1e-9);
                                          last = fraction;
                                          return true;
                                      }});
    ASSERT_TRUE(static_cast<bool>(outcomes)) << outcomes.error().text();
    EXPECT_GT(last, 0.999);
    std::set<std::string_view> names;
    for (std::size_t k = 0; k < all_studies().size(); ++k) {
        EXPECT_TRUE(names.insert(all_studies()[k]->name).second) << all_studies()[k]->name;
        check(*all_studies()[k], (*outcomes)[k]);
        for (const auto& c : (*outcomes)[k].claims)
            EXPECT_TRUE(all_studies()[k]->name != "touch" || !c.has_allowed_range() || c.is_in_allowed_range())
                << c.label << ": " << c.computed;
    }
    EXPECT_LT(count_unexplained(*outcomes), 10);
    EXPECT_NE(on_one_line(test::read_file(test::source_root() + "/README.md")).find(prediction_sentence(*outcomes)), std::string::npos)
        << "README.md must say: " << prediction_sentence(*outcomes);
    const auto text = markdown_of(all_studies(), *outcomes), page = test::read_file(test::source_root() + "/reproduction/reproduction.md");
    EXPECT_EQ(text, page) << "reproduction/reproduction.md is stale: make reproduction";
}

TEST(Studies, OfARecordingGiveTheTextOfTheirPage) {
    for (const auto* s : recorded_studies) CORPUSCLE_NEEDS(test::shared_file_path(std::string(s->recording_folder)));
    const auto outcomes = run_studies(recorded_studies, {.recordings_folder = test::shared_file_path("")});
    ASSERT_TRUE(static_cast<bool>(outcomes)) << outcomes.error().text();
    for (std::size_t k = 0; k < std::size(recorded_studies); ++k) check(*recorded_studies[k], (*outcomes)[k]);
    EXPECT_EQ(markdown_of(recorded_studies, *outcomes), test::read_file(test::source_root() + "/reproduction/recorded.md"))
        << "stale: make reproduction";
}

TEST(Studies, OfAMissingRecordingNameTheSearchedPath) {
    for (const auto* s : recorded_studies) {
        const auto outcome = s->run({.recordings_folder = "/nowhere"});
        ASSERT_FALSE(outcome);
        EXPECT_NE(outcome.error().message.find("'/nowhere/" + std::string(s->recording_folder) + "'"), std::string::npos)
            << outcome.error().text();
    }
}

TEST(Studies, OfAKitSayThatTheyAreLeftOutWithoutOne) {
    for (const auto* s : kit_studies) {
        const auto outcome = s->run({});
        ASSERT_FALSE(outcome);
        EXPECT_NE(outcome.error().message.find("left out: no kit is named; set CORPUSCLE_FOUNDRY_CARD"), std::string::npos);
    }
}

TEST(Studies, OfAKitMeasureItsTransistorsBesideTheCard) {
    const auto card = test::source_root() + "/test/kits/made_up_bsim3.lib";
    const auto outcomes = run_studies(kit_studies, {.kit = {.card = card, .map = "bsim", .nch = "made_n", .pch = "made_p"}});
    ASSERT_TRUE(static_cast<bool>(outcomes)) << outcomes.error().text();
    const auto& claims = (*outcomes)[0].claims;
    EXPECT_EQ(claims.size(), 2 * (10U + 7U + 5U));
    const auto computed = [&](const std::string& label) {
        const auto at = std::find_if(claims.begin(), claims.end(), [&](const Claim& c) { return c.label == label; });
        return at == claims.end() ? Claim::none : at->computed;
    };
    for (const auto& c : claims) EXPECT_TRUE(std::isfinite(c.computed)) << c.label;
    // A direct run of ngspice on a deck written by hand: 351.7433 mV and 11.07337 nA.
    EXPECT_NEAR(computed("INVA without bias: V_Q, kit"), 0.3517433, 1e-7);
    EXPECT_NEAR(computed("INVA without bias: I_Q, kit"), 11.07337e-9, 1e-13);
    EXPECT_NEAR(computed("INVA without bias: I_Q, UICM"), 17.5e-9, 0.1e-9);
    const auto wrong = run_studies(kit_studies, {.kit = {.card = card, .map = "bsim", .nch = "made_m", .pch = "made_p"}});
    ASSERT_FALSE(static_cast<bool>(wrong));
    EXPECT_NE(wrong.error().message.find("it has no .model made_m"), std::string::npos) << wrong.error().text();
}

TEST(Studies, StopOnRequest) {
    for (const auto* s : all_studies()) {
        const auto outcome = s->run({[](double) { return false; }});
        ASSERT_FALSE(outcome) << s->name;
        EXPECT_EQ(outcome.error().code, ErrorCode::interrupted) << s->name;
    }
}

TEST(Studies, TheFourAfferentTypesFireWhereTheFigureShowsThem) {
    for (const auto& c : run("fig3").claims)
        EXPECT_TRUE(!c.has_allowed_range() || c.is_in_allowed_range()) << c.label << ": " << c.computed;
}

TEST(Studies, TheHoldOfTheKimModelIsWithinThePublishedSpread) {
    const auto outcome = run("kim");
    for (const auto& c : outcome.claims) EXPECT_TRUE(!c.has_allowed_range() || c.is_in_allowed_range()) << c.label << ": " << c.computed;
    EXPECT_NEAR(claim(outcome, "interval in the hold at 1.3 mm").computed, 56.8e-3, 0.5e-3);
}

TEST(Studies, MoreBitsAndSamplesGiveSmallerErrors) {
    const auto outcome = run("resolution");
    for (const char* name : {"sa1", "fa1"}) {
        const auto at = [&](const char* what) { return claim(outcome, std::string(name) + what + ": rms error of spike times").computed; };
        EXPECT_GT(at(": 4 bits, 10 kHz"), 10 * at(": 12 bits, 10 kHz"));
        EXPECT_LT(at(": 16 bits, 10 kHz"), 0.2e-3);
        EXPECT_GT(at(": 16 bits, 100 Hz"), 5 * at(": 16 bits, 1 kHz"));
    }
}

TEST(Studies, AClaimHoldsOnlyWithinItsAllowedRange) {
    Claim c{.label = "x", .computed = 2};
    EXPECT_FALSE(c.has_allowed_range());
    c.allowed_max = 1;
    EXPECT_TRUE(c.has_allowed_range());
    EXPECT_FALSE(c.is_in_allowed_range());
    c.allowed_max = 2, c.allowed_min = 2;
    EXPECT_TRUE(c.is_in_allowed_range());
}

TEST(Studies, AClaimReportsItsDistanceFromThePublishedValue) {
    StudyResult out;
    const auto claim = [&](double computed_value, double published_value) {
        return out.claim("x", computed_value, "V").published_as(published_value, "there");
    };
    EXPECT_STREQ(claim(1.09, 1).verdict(), "agrees");
    EXPECT_STREQ(claim(1.11, 1).verdict(), "differs");
    EXPECT_STREQ(claim(-1.11, -1).verdict(), "differs");
    EXPECT_STREQ(claim(0.5, 0).verdict(), "");
    EXPECT_STREQ(claim(std::numeric_limits<double>::quiet_NaN(), 1).verdict(), "");
    EXPECT_EQ(format_deviation(claim(0.75, 1)), "-25.0 %");
    EXPECT_EQ(format_deviation(claim(-0.75, -1)), "+25.0 %");
    EXPECT_STREQ(out.claim("y", 3).allow_max(2, "there").verdict(), "does not hold");
    EXPECT_EQ(format_published(out.claim("z", 3).derived_as(2, "an equation")), "(2)");
    EXPECT_STREQ(out.claim_true("so", true, "there").verdict(), "holds");
    EXPECT_STREQ(out.claim_true("so", false, "there").verdict(), "does not hold");
}

TEST(Studies, AClaimIsWrittenInItsUnit) {
    StudyResult out;
    EXPECT_EQ(format_claim_value(2e-9, out.claim("a", 2e-9, "A")), "2 nA");
    EXPECT_EQ(format_claim_value(0.02, out.claim("b", 0.02, "%")), "0.02 %");
    EXPECT_EQ(format_claim_value(1, out.claim_true("c", true, "there")), "yes");
    EXPECT_EQ(format_allowed_range(out.claim("d", 1, "V").allow_range(0.5, 2, "there")), "500 mV to 2 V");
    EXPECT_EQ(format_allowed_range(out.claim("e", 1, "V").allow_min(0.5, "there")), "at least 500 mV");
    EXPECT_EQ(format_allowed_range(out.claim("f", 1)), "-");
    EXPECT_EQ(format_claim_value(3e-14, out.claim("g", 3e-14, "%")), "0 %") << "rounding errors differ between machines";
    EXPECT_EQ(format_claim_value(3e-15, out.claim("h", 3e-15, "V").allow_max(1e-9, "there")), "0 V");
    EXPECT_EQ(format_claim_value(3e-12, out.claim("i", 3e-12, "V").allow_max(1e-9, "there")), "3 pV");
}

TEST(Studies, AClaimWithAToleranceOfItsOwnIsComparedByIt) {
    StudyResult out;
    const auto claim = [&](double computed_value, double published_value, double tolerance) {
        return out.claim("V_Q", computed_value, "V").published_as(published_value, "there").within(tolerance);
    };
    EXPECT_STREQ(claim(0.3503, 0.347, 0.3e-3).verdict(), "differs");
    EXPECT_STREQ(claim(0.3472, 0.347, 0.3e-3).verdict(), "agrees");
    EXPECT_STREQ(claim(0.1, 0, 0.2).verdict(), "agrees") << "also of 0, which has no relative deviation";
    EXPECT_STREQ(claim(0.3, 0, 0.2).verdict(), "differs");
    EXPECT_STREQ(claim(Claim::none, 1, 0.2).verdict(), "");
    EXPECT_EQ(format_allowed_range(claim(0.35, 0.347, 0.3e-3)), "within 300 uV");
}

Result<StudyResult> gives_two_claims(const StudyOptions&) {
    StudyResult out;
    out.claim("a", 1).published_as(1, "there");
    out.claim("b", 1).published_as(2, "there").of_kind(ClaimKind::misprint);
    out.next_kind = ClaimKind::arithmetic;
    out.claim("c", 1).derived_as(1, "there");
    out.claim("d", 1);
    return out;
}

TEST(Studies, AClaimHasTheKindOfItsStudyOrItsOwn) {
    const Study study{"s", "", "", ClaimKind::fitted, gives_two_claims};
    const auto outcome = test::value_or_throw(study.run({}));
    EXPECT_EQ(outcome.claims[0].kind, ClaimKind::fitted);
    EXPECT_EQ(outcome.claims[1].kind, ClaimKind::misprint);
    EXPECT_EQ(outcome.claims[2].kind, ClaimKind::arithmetic);
    const auto counts = count_by_kind(std::span(&outcome, 1));
    ASSERT_EQ(counts.size(), claim_kinds().size());
    const auto of = [&](ClaimKind kind) { return counts[static_cast<std::size_t>(kind)]; };
    EXPECT_EQ(of(ClaimKind::fitted).printed.agreeing, 1);
    EXPECT_EQ(of(ClaimKind::misprint).printed.deviating, 1);
    EXPECT_EQ(of(ClaimKind::arithmetic).derived.agreeing, 1) << "d has no verdict and does not count";
    EXPECT_EQ(of(ClaimKind::predicted).printed.agreeing, 0);
}

TEST(Studies, TheTableOfKindsIsInTheOrderOfTheKinds) {
    for (std::size_t k = 0; k < claim_kinds().size(); ++k) {
        EXPECT_EQ(static_cast<std::size_t>(claim_kinds()[k].kind), k);
        EXPECT_FALSE(claim_kinds()[k].meaning.empty());
        EXPECT_EQ(test::value_or_throw(find_claim_kind(claim_kinds()[k].name)), claim_kinds()[k].kind);
    }
    EXPECT_EQ(
        find_claim_kind("fited").error().message,
        "unknown kind of claim 'fited'; did you mean 'fitted'? (known: predicted, fitted, input, identity, arithmetic, misprint, ours)");
}

Result<StudyResult> fails(const StudyOptions&) { return bad_input("no such thing"); }
Result<StudyResult> succeeds(const StudyOptions&) { return StudyResult{}; }

TEST(Studies, TheFirstErrorEndsAllAndNamesItsStudy) {
    const Study good{"good", "", "", ClaimKind::ours, succeeds}, bad{"bad", "", "", ClaimKind::ours, fails};
    const Study* all[] = {&good, &bad, &good};
    const auto outcomes = run_studies(all, {});
    ASSERT_FALSE(outcomes);
    EXPECT_EQ(outcomes.error().message, "bad: no such thing");
}

TEST(Studies, TheirMarkdownTableEscapesItsText) {
    const Study study{"s", "A title", "A question", ClaimKind::predicted, succeeds};
    const Study* all[] = {&study};
    StudyResult out;
    out.claim("|a| over b", 1, "V").published_as(2, "table 1").explain("x | y").of_kind(ClaimKind::fitted);
    const auto text = markdown_of(all, std::span(&out, 1));
    EXPECT_NE(text.find("| \\|a\\| over b | 1 V | 2 V | -50.0 % | - | differs | fitted | table 1; x \\| y |\n"), std::string::npos) << text;
    EXPECT_NE(text.find("\n| fitted | 0 | 1 | 0 | 0 | 0 | 0 | the process card"), std::string::npos) << text;
    EXPECT_NE(text.find("Of 0 printed numbers that were predicted without a fit, 0 agree and 0 differ;"), std::string::npos) << text;
}

}  // namespace
}  // namespace corpuscle
