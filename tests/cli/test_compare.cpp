// pullfocus compare on small shots: what is exact is exact, all reports tell the same, and limits judge both ways.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "program.h"
#include "strict_xml.h"

namespace pullfocus::test {
namespace {

using nlohmann::json;
using Fields = std::map<std::string, std::string>;

std::vector<std::string> csv_cells(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  }
  return cells;
}

std::vector<Fields> csv_rows(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  const auto names = csv_cells(line);
  std::vector<Fields> rows;
  while (std::getline(lines, line)) {
    const auto cells = csv_cells(line);
    EXPECT_EQ(cells.size(), names.size()) << line;
    rows.emplace_back();
    for (std::size_t i = 0; i < std::min(cells.size(), names.size()); ++i) rows.back()[names[i]] = cells[i];
  }
  return rows;
}

class Compare : public testing::Test {
 protected:
  // Rendered once for all tests.
  static void SetUpTestSuite() {
    shots = std::make_unique<TempFolder>();
    ASSERT_EQ(run(fmt::format("render star-lateral -o '{}' --size 96x64 --frames 40-45", shots->path())).code, 0);
  }
  static void TearDownTestSuite() { shots.reset(); }

  static std::string star() { return *shots / "star-lateral.####.exr"; }
  Outcome compare(const std::string& options) {
    return run(fmt::format("compare '{}' --lens paper {}", star(), options));
  }
  json report(const std::string& options) {
    const Outcome outcome = compare(options + fmt::format(" --json '{}'", folder / "r.json"));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return json::parse(exr::test::file_bytes(folder / "r.json"));
  }
  std::string filtered(const std::string& name, const std::string& options) {
    EXPECT_EQ(run(fmt::format("filter '{}' -o '{}' --mkdir --lens paper {}", star(), folder / name, options)).code, 0);
    return folder / (name + "/star-lateral.####.exr");
  }

  static inline std::unique_ptr<TempFolder> shots;
  TempFolder folder;
};

TEST_F(Compare, AFullBudgetHasExactlyNoErrorAgainstLinearAndAPartialOneHas) {
  const json r = report("--budgets 5%,40%,100% --kernels 'disc,polygon:5' --coc-steps 0.03125,0.1");
  const json& filters = r["shots"][0]["filters"];
  ASSERT_EQ(filters.size(), 2u * 2 * 4);
  for (const json& filter : filters) {
    const json& errors = filter["errors"]["linear"];
    const bool exact = filter["method"] == "linear" || filter["budget"] == "100%";
    EXPECT_EQ(errors["rmse"] == 0, exact) << filter["label"];
    EXPECT_EQ(errors["largest"] == 0, exact) << filter["label"];
    EXPECT_EQ(errors["psnr"].is_null(), exact) << filter["label"];
    EXPECT_EQ(errors["flip"] == 0, exact) << filter["label"];
    EXPECT_EQ(errors["ssim"] == 1, exact) << filter["label"];
    ASSERT_EQ(filter["frames"].size(), 6u);
    EXPECT_EQ(filter["frames"][0]["errors"]["linear"]["largest"], 0) << "the first frame is done in full";
    if (filter["budget"] == "5%") {
      EXPECT_GT(filter["frames"][5]["left_over"], 0);
    }
    EXPECT_EQ(filter["errors"].contains("quantisation"), filter["method"] == "linear");
  }
}

TEST_F(Compare, AFinerCocStepHasLessErrorOfQuantisation) {
  const json r = report("--methods linear --coc-steps 0.5,0.0625,0 --output-type float");
  const json& filters = r["shots"][0]["filters"];
  ASSERT_EQ(filters.size(), 3u);
  const auto rmse = [&](std::size_t i) { return filters[i]["errors"]["quantisation"]["rmse"].get<double>(); };
  EXPECT_GT(rmse(0), rmse(1));
  EXPECT_GE(rmse(1), rmse(2));
  EXPECT_GT(rmse(2), 0);
}

TEST_F(Compare, TheTruthOfALinearFilterIsItsOwnOutput) {
  const std::string truth = filtered("truth", "--method linear");
  std::filesystem::remove(folder / "truth/star-lateral.0042.exr");  // a truth may leave frames out
  const json r = report(fmt::format("--truth '{}' --budgets 5%,100%", truth));
  const json& filters = r["shots"][0]["filters"];
  EXPECT_EQ(filters[0]["errors"]["truth"]["largest"], 0);
  EXPECT_EQ(filters[2]["errors"]["truth"]["largest"], 0);
  EXPECT_GT(filters[1]["errors"]["truth"]["largest"], 0);
  EXPECT_FALSE(filters[0]["frames"][2]["errors"].contains("truth"));
  EXPECT_TRUE(filters[0]["frames"][3]["errors"].contains("truth"));
}

TEST_F(Compare, MeasuringEveryKthFrameLeavesWorkAndThoseFramesErrorsAsTheyAre) {
  const std::string truth = filtered("truth", "--method linear --fstop 5");
  const std::string options = fmt::format("--truth '{}' --budgets 5%,100%", truth);
  const json all = report(options)["shots"][0], some = report(options + " --measure-every 4")["shots"][0];
  EXPECT_EQ(some["measure_every"], 4);
  for (std::size_t i = 0; i < 3; ++i) {
    const json &a = all["filters"][i]["frames"], &b = some["filters"][i]["frames"];
    ASSERT_EQ(b.size(), 6u);
    for (std::size_t frame = 0; frame < 6; ++frame) {
      EXPECT_EQ(a[frame]["updated"], b[frame]["updated"]);
      EXPECT_EQ(b[frame].contains("errors"), frame % 4 == 0);
      if (b[frame].contains("errors")) {
        EXPECT_EQ(a[frame]["errors"], b[frame]["errors"]);
      }
    }
  }
  for (int frame : {40, 44}) std::filesystem::remove(folder / fmt::format("truth/star-lateral.00{}.exr", frame));
  const Outcome outcome = compare(options + " --measure-every 4");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--measure-every"), std::string::npos) << outcome.err;
  for (const char* wrong : {"0", "-2", "1.5", "x"}) {
    EXPECT_EQ(compare(fmt::format("--measure-every {}", wrong)).code, 2) << wrong;
  }
}

TEST_F(Compare, MarkdownHasOneTableOfTheTablesNumbers) {
  const Outcome outcome = compare(fmt::format("--measure-every 2 --markdown '{}'", folder / "r.md"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::istringstream lines(exr::test::file_bytes(folder / "r.md"));
  std::string line;
  std::vector<std::ptrdiff_t> bars;
  std::size_t known = 0, numbers = 0;
  while (std::getline(lines, line)) {
    if (line.empty() || line[0] != '|') continue;
    bars.push_back(std::ranges::count(line, '|'));
    if (bars.size() < 3) continue;
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      if (word.find_first_of("0123456789") == std::string::npos || word.back() == '%') continue;
      ++numbers;
      known += outcome.out.find(word) != std::string::npos;
    }
  }
  ASSERT_EQ(bars.size(), 2u + 4);  // linear, three budgets
  for (const auto count : bars) EXPECT_EQ(count, bars.front());
  EXPECT_GT(numbers, 30u);
  EXPECT_EQ(known, numbers) << "the terminal shows the same";
}

TEST_F(Compare, TableCsvJsonAndPageHoldTheSameNumbers) {
  const std::string truth = filtered("truth", "--method linear --fstop 5");
  const Outcome outcome = compare(fmt::format("--truth '{}' --orders gain,fearing --json '{}' --csv '{}' --html '{}'",
                                              truth, folder / "r.json", folder / "r.csv", folder / "r.html"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json filters = json::parse(exr::test::file_bytes(folder / "r.json"))["shots"][0]["filters"];
  const auto rows = csv_rows(exr::test::file_bytes(folder / "r.csv"));
  const std::string page = exr::test::file_bytes(folder / "r.html");
  ASSERT_EQ(filters.size(), 6u);  // linear, two orders of two budgets, all
  ASSERT_EQ(rows.size(), filters.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const json& filter = filters[i];
    EXPECT_EQ(rows[i].at("method"), filter["method"]);
    EXPECT_EQ(rows[i].at("budget"), filter["budget"].is_null() ? "" : filter["budget"]);
    EXPECT_EQ(rows[i].at("order"), filter["order"].is_null() ? "" : filter["order"]);
    EXPECT_EQ(rows[i].at("input"), star());
    for (const char* time : {"first_ms", "median_ms", "speed_up", "updated_share"}) {
      EXPECT_EQ(std::stod(rows[i].at(time)), filter[time].get<double>()) << time;
    }
    for (const auto& [against, errors] : filter["errors"].items()) {
      for (const auto& [measure, value] : errors.items()) {
        const std::string text = rows[i].at(against + "_" + measure);
        EXPECT_EQ(std::stod(text), value.is_null() ? INFINITY : value.get<double>()) << measure;
        std::string shown = measure == "psnr"   ? fmt::format("{:.2f}", std::stod(text))
                            : measure == "ssim" ? fmt::format("{:.5f}", value.get<double>())
                            : value == 0        ? "0"
                                                : fmt::format("{:.3e}", value.get<double>());
        EXPECT_NE(outcome.out.find("  " + shown), std::string::npos) << measure << " " << shown;
        EXPECT_NE(page.find(">" + shown + "</td>"), std::string::npos) << measure << " " << shown;
      }
    }
  }
}

TEST_F(Compare, SummariesFollowFromTheFrames) {
  const json r = report("--budgets 10%");
  const json& filter = r["shots"][0]["filters"][1];
  double squares = 0, flip = 0, largest = 0;
  for (const json& frame : filter["frames"]) {
    const json& e = frame["errors"]["linear"];
    squares += std::pow(e["rmse"].get<double>(), 2) / 6;
    flip += e["flip"].get<double>() / 6;
    largest = std::max(largest, e["largest"].get<double>());
    EXPECT_EQ(frame["changed"].get<int>(), frame["updated"].get<int>() + frame["left_over"].get<int>());
  }
  const json& all = filter["errors"]["linear"];
  EXPECT_NEAR(all["rmse"].get<double>(), std::sqrt(squares), 1e-12);
  EXPECT_NEAR(all["flip"].get<double>(), flip, 1e-12);
  EXPECT_EQ(all["largest"].get<double>(), largest);
}

TEST_F(Compare, ThePageIsWellFormedAndNeedsNothingElse) {
  const std::string odd = folder / "a & <b>'s \xc3\xbc";
  ASSERT_EQ(run(fmt::format("render star-lateral -o \"{}\" --size 40x30 --frames 40-42", odd)).code, 0);
  ASSERT_EQ(run(fmt::format("compare \"{}/star-lateral.####.exr\" '{}' --lens paper --html '{}'", odd, star(),
                            folder / "p.html"))
                .code,
            0);
  const std::string page = exr::test::file_bytes(folder / "p.html");
  EXPECT_EQ(xml_problem(page), "");
  EXPECT_NE(page.find("a &amp; &lt;b&gt;'s \xc3\xbc"), std::string::npos);
  for (const char* outside : {"<script", "<link", "url(", "@import", "<iframe"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  for (const char* reference : {"src=\"", "href=\""}) {
    for (std::size_t at = page.find(reference); at != std::string::npos; at = page.find(reference, at + 1)) {
      EXPECT_EQ(page.compare(at + std::string(reference).size(), 22, "data:image/png;base64,"), 0);
    }
  }
  EXPECT_NE(page.find("iVBORw0KGgo"), std::string::npos);  // a PNG's first bytes
}

TEST_F(Compare, TheXmlCheckItselfFindsMistakes) {
  EXPECT_EQ(xml_problem("<a b=\"1\"><c/>x &amp; y</a>\n"), "");
  for (const char* wrong :
       {"<a>", "<a></b>", "<a><b></a></b>", "<a b=1/>", "<a b=\"1\" b=\"2\"/>", "<a>&nbsp;</a>", "<a>x & y</a>",
        "<a/><a/>", "x<a/>", "<a b=\"1\"c=\"2\"/>", "<a b=\"<\"/>", "", "<a>\x01</a>"}) {
    EXPECT_NE(xml_problem(wrong), "") << wrong;
  }
}

TEST_F(Compare, LimitsJudgeBothWaysAndNameFilterFrameAndValue) {
  EXPECT_EQ(
      compare("--budgets 100% --fail-above largest=0 --fail-above rmse=0,flip=0 --fail-below ssim=1,psnr=1000").code,
      0);
  const Outcome outcome = compare("--budgets 5%,100% --fail-above rmse=1e-9 --fail-below psnr=1000");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.error_lines(), 2u) << outcome.err;
  for (const char* word :
       {"--fail-above rmse=1e-9: ", "incremental 5%: frame 4", "rmse against linear is ", "--fail-below psnr=1000: "}) {
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " in " << outcome.err;
  }
  EXPECT_NE(outcome.out.find("incremental 100%"), std::string::npos) << "the table is printed all the same";
  EXPECT_EQ(compare("--methods linear --fail-above quantisation.flip=1").code, 0);
  EXPECT_EQ(compare("--methods linear --fail-above quantisation.rmse=0").code, 1);
}

TEST_F(Compare, GivenSequencesAreComparedWithoutFiltering) {
  const std::string a = filtered("a", "--method linear"), b = filtered("b", ""), c = filtered("c", "--fstop 3.4");
  const auto given = [&](const std::string& x, const std::string& y, const std::string& options) {
    return run(fmt::format("compare '{}' --given --reference '{}' {}", x, y, options));
  };
  EXPECT_EQ(given(a, b, "--fail-above largest=0").code, 0);
  const Outcome outcome =
      given(a, c,
            fmt::format("--fail-above largest=0 --fail-above reference.flip=1 --html '{}' --csv '{}'",
                        folder / "g.html", folder / "g.csv"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
  EXPECT_NE(outcome.err.find("given: frame 4"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("largest against reference is "), std::string::npos) << outcome.err;
  EXPECT_EQ(xml_problem(exr::test::file_bytes(folder / "g.html")), "");
  EXPECT_GT(std::stod(csv_rows(exr::test::file_bytes(folder / "g.csv"))[0].at("reference_rmse")), 0);
  const std::string one = folder / "c/star-lateral.0042.exr";
  EXPECT_EQ(given(folder / "a/star-lateral.0043.exr", one, "").code, 0) << "single files go together";
  std::filesystem::remove(one);
  EXPECT_NE(given(a, c, "").err.find("frames 42 of"), std::string::npos);
  EXPECT_NE(given(c, a, "").err.find("frames 42 of"), std::string::npos);
  EXPECT_EQ(given(a, c, "").code, 1);
  EXPECT_EQ(given(a, c, "--frames 43-45").code, 0);
}

TEST_F(Compare, GivenNotANumberFailsEveryLimit) {
  const Window w{0, 0, 16, 12};
  for (const char* name : {"good.exr", "bad.exr"}) {
    TestImage image(w, w);
    for (const char* channel : {"R", "G", "B"}) image.add_constant(channel, Imf::FLOAT, name[0] == 'b' ? NAN : 0.5f);
    exr::test::write_scanlines(folder / name, image);
  }
  const Outcome outcome = run(fmt::format("compare '{}' --given --reference '{}' --fail-above rmse=1e30 --json '{}'",
                                          folder / "bad.exr", folder / "good.exr", folder / "n.json"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("is nan"), std::string::npos) << outcome.err;
  EXPECT_TRUE(
      json::parse(exr::test::file_bytes(folder / "n.json"))["shots"][0]["filters"][0]["errors"]["reference"]["rmse"]
          .is_null());
}

TEST_F(Compare, QuickRunsFewFramesAndBudgetsAndTakesSeveralInputs) {
  ASSERT_EQ(run(fmt::format("render star-lateral -o '{}' --size 48x32 --frames 1-9", folder / "long")).code, 0);
  const Outcome outcome = run(fmt::format("compare '{}' '{}' --lens paper --quick --json '{}'",
                                          folder / "long/star-lateral.####.exr", star(), folder / "q.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json shots_found = json::parse(exr::test::file_bytes(folder / "q.json"))["shots"];
  ASSERT_EQ(shots_found.size(), 2u);
  EXPECT_EQ(shots_found[0]["filters"][0]["frames"].size(), 6u);
  EXPECT_EQ(shots_found[0]["filters"].size(), 3u);
  EXPECT_FALSE(shots_found[0]["filters"][0]["errors"].contains("quantisation"));
}

TEST_F(Compare, MistakesAreOneLineThatNamesTheOptionAndExitWithTwo) {
  const std::string other = folder / "other";
  ASSERT_EQ(run(fmt::format("render star-lateral -o '{}' --size 32x32 --frames 90-91", other)).code, 0);
  const std::pair<std::string, std::string> cases[] = {
      {"--methods fast", "--method 'fast'"},
      {"--methods linear,,incremental", "--methods"},
      {"--budgets 0%", "--budget"},
      {"--budgets 5%,5%", "5% twice"},
      {"--orders best", "--order"},
      {"--visibilities glass", "--visibility"},
      {"--coc-steps 0.1,x", "--coc-step"},
      {"--kernels 'disc;star'", "--kernel"},
      {"--fail-above rmse", "METRIC=VALUE"},
      {"--fail-above sharpness=1", "no measure"},
      {"--fail-above psnr=30", "use --fail-below"},
      {"--fail-below rmse=30", "use --fail-above"},
      {"--fail-above rmse=x", "no number"},
      {"--fail-above moon.rmse=1", "unknown error"},
      {"--fail-above truth.rmse=1", "give --truth"},
      {"--quick --fail-above quantisation.rmse=1", "--quick"},
      {"--given", "--reference"},
      {"--reference x.####.exr", "--given"},
      {"--peak 0", "--peak"},
      {"--truth a.exr --truth b.exr", "--truth is given 2 times for 1 inputs"},
      {fmt::format("--truth '{}/star-lateral.####.exr'", other), "display window"},
      {"--budget 5%", "--budget"}};
  for (const auto& [options, word] : cases) {
    const Outcome outcome = compare(options);
    EXPECT_EQ(outcome.code, 2) << options << ": " << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " in: " << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  for (const std::string& options :
       {fmt::format("--json '{}/no/r.json'", folder.path()), fmt::format("--html '{}'", folder.path())}) {
    const Outcome outcome = compare(options);
    EXPECT_EQ(outcome.code, 1) << options;
    EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
    EXPECT_EQ(outcome.out, "") << "found before the work is done";
  }
  EXPECT_EQ(run("compare").code, 2);
  EXPECT_NE(compare("--truth missing.####.exr").err.find("--truth: missing"), std::string::npos);
}

TEST_F(Compare, ACyclesShotGoesThroughAsItIs) {
  if (shared_data("cycles").empty()) GTEST_SKIP() << "../shared/data/cycles is not there";
  const std::string mover = shared_data("cycles/mover"), still = shared_data("cycles/static_pull");
  const Outcome outcome = run(fmt::format(
      "compare '{0}/pinhole_####.exr' --truth '{0}/gt_####.exr' --focal-length 50 --fstop 2 --focus 0.8 "
      "--visibility none --quick --json '{1}' --fail-above largest=10 --fail-below truth.psnr=22 --budgets 15%,100%",
      mover, folder / "m.json"));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const json filters = json::parse(exr::test::file_bytes(folder / "m.json"))["shots"][0]["filters"];
  EXPECT_EQ(filters[2]["errors"]["linear"]["largest"], 0);
  EXPECT_GT(filters[1]["errors"]["linear"]["largest"], 0);
  EXPECT_NEAR(filters[0]["frames"][0]["errors"]["truth"]["psnr"].get<double>(), 28.118,
              0.02);  // plain scatter, by exrcheck.py
  for (const char* focus : {"0.32", "0.80", "2.70"}) {
    const Outcome pull = run(fmt::format(
        "compare '{0}/pinhole_0001.exr' --truth '{0}/gt_f{1}_0001.exr' --focal-length 50 --fstop 2.4 --focus {1} "
        "--visibility none --methods linear --fail-below truth.psnr=25",
        still, focus));
    EXPECT_EQ(pull.code, 0) << focus << ": " << pull.err;
  }
}

}  // namespace
}  // namespace pullfocus::test
