#include "io/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "io/heat_map.hpp"

namespace acinus::io {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

Plot sample() {
  return {"error < cost & more",
          "CPU time (s)",
          "error",
          true,
          true,
          {{"implicit", {{1, 0.1}, {10, 0.01}, {100, 0.001}}, true, true},
           {"explicit", {{50, 0.1}, {500, 0.05}}, true, false}}};
}

TEST(Plot, HasEveryPointLineAndName) {
  const std::string svg = draw_plot(sample());
  EXPECT_EQ(count(svg, "<circle"), 5u);
  EXPECT_EQ(count(svg, "fill=\"none\" stroke=\"#0072b2\""), 1u);
  EXPECT_EQ(count(svg, "fill=\"none\" stroke=\"#d55e00\""), 0u) << "not joined";
  for (const char* word : {"implicit", "explicit", "CPU time (s)", "error &lt; cost &amp; more"})
    EXPECT_EQ(count(svg, word), 1u) << word;
  EXPECT_EQ(count(svg, "<svg"), 1u);
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
}

TEST(Plot, LogarithmicAxesAreEvenInDecades) {
  const std::string svg = draw_plot(sample());
  for (const char* tick : {">1<", ">10<", ">100<", ">0.01<", ">0.001<"})
    EXPECT_EQ(count(svg, tick), 1u) << tick;
}

TEST(Plot, LeavesOutWhatCannotBeDrawn) {
  Plot p = sample();
  p.line[0].point.push_back({1, 0});
  p.line[0].point.push_back({-1, 1});
  p.line[0].point.push_back({std::nan(""), 1});
  p.line[0].point.push_back({1, std::numeric_limits<double>::infinity()});
  const std::string svg = draw_plot(p);
  EXPECT_EQ(count(svg, "<circle"), 5u);
  EXPECT_EQ(count(svg, "nan"), 0u);
  EXPECT_EQ(count(svg, "inf"), 0u);
  EXPECT_EQ(count(draw_plot({"nothing", "x", "y", false, false, {}}), "no points"), 1u);
}

TEST(Plot, OnePointGetsAnAxisOfItsOwn) {
  const std::string svg = draw_plot({"one", "x", "y", false, false, {{"a", {{3, 7}}, true, true}}});
  EXPECT_EQ(count(svg, "<circle"), 1u);
  EXPECT_EQ(count(svg, "nan"), 0u);
}

TEST(Plot, LogarithmicAxesOfFewDecadesHaveRoundNumbers) {
  const auto svg_over = [](double high) {
    return draw_plot({"", "x", "y", true, false, {{"a", {{1e9, 1}, {high, 2}}}}});
  };
  for (const char* tick : {">1e+09<", ">2e+09<", ">5e+09<", ">1e+10<", ">2e+10<"})
    EXPECT_EQ(count(svg_over(3e10), tick), 1u) << tick;
  for (const char* tick : {">1e+09<", ">1.2e+09<", ">1.4e+09<", ">1.6e+09<"})
    EXPECT_EQ(count(svg_over(1.6e9), tick), 1u) << tick;
}

TEST(Plot, LabelsKeepClearOfEachOther) {
  // The numbers end 6 left of the axis; the label stands at 20.
  const std::string wide =
      draw_plot({"", "x", "y", false, false, {{"a", {{0, 1.111e-7}, {1, 1.119e-7}}}}});
  const std::size_t at = wide.find("text-anchor=\"end\"");
  ASSERT_NE(at, wide.npos);
  const double end = std::stod(wide.substr(wide.rfind("x=\"", at) + 3));
  EXPECT_GT(end - 6.6 * 9, 20 + 6);  // such as 1.112e-07
  const std::string label(80, 'm');
  EXPECT_EQ(count(draw_plot({"", label, "y", false, false, {{"a", {{0, 0}, {1, 1}}}}}),
                  "font-size=\"10.2\""),
            1u);
}

TEST(Plot, PanelsShareOneRangeAndOneLegend) {
  Plot low{"low", "x", "y", false, false, {{"a", {{0, 0}, {30, 0.1}}}, {"b", {{0, 0}, {30, 0.2}}}}};
  Plot high = low;
  high.title = "high";
  high.line[0].point[1].second = 1;
  const std::string svg = draw_panels({low, high});
  EXPECT_EQ(count(svg, "<svg"), 3u);
  EXPECT_EQ(count(svg, ">a<"), 1u);
  EXPECT_EQ(count(svg, ">b<"), 1u);
  EXPECT_EQ(count(svg, ">0.8<"), 2u) << "both axes go up to 1";
}

TEST(HeatMap, ShowsFieldsScaleAndWhatIsNotKnown) {
  HeatMap map{"closing", "W", "force", "seeds below", {"1 mN/m", "2 mN/m"}, {"0.3 nN"}, {}};
  map.field = {{{0.8, {"3 d", "4 of 5 seeds"}}, {std::nullopt, {"not measured"}}}};
  const std::string svg = draw_heat_map(map);
  for (const char* word : {"closing", ">W<", ">force<", "1 mN/m", "2 mN/m", "0.3 nN",
                           "4 of 5 seeds", "not measured", "100 %", "seeds below"})
    EXPECT_EQ(count(svg, word), 1u) << word;
  EXPECT_EQ(count(svg, "url(#unknown)"), 1u);
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
}

}  // namespace
}  // namespace acinus::io
