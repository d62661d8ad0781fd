#include "core/json_size.hpp"

#include <gtest/gtest.h>

#include "tests/messages.hpp"

namespace acinus {
namespace {

std::string repeated(const std::string& text, int n) {
  std::string all;
  for (int k = 0; k < n; ++k) all += text;
  return all;
}

TEST(JsonSize, RefusesWhatIsNestedTooDeep) {
  EXPECT_EQ(fault_of_json_size(repeated("[", 100) + repeated("]", 100)), "");
  for (const std::string& text :
       {repeated("[", 101), repeated("{\"a\":", 200'000), repeated("[{\"a\":", 60),
        "{\"a\": \"\\\"\", \"b\": " + repeated("[", 100), "/* \" */" + repeated("[", 200),
        "// \"\n" + repeated("[", 200)})
    EXPECT_CONTAINS(fault_of_json_size(text), "deeper than 100") << text.substr(0, 40);
}

TEST(JsonSize, TakesBracketsInTextsAndCommentsForWhatTheyAre) {
  for (const std::string& text :
       {"\"" + repeated("[", 200) + "\"", "\"\\\"" + repeated("[", 200) + "\"",
        "//" + repeated("[", 200) + "\n1", "/*" + repeated("[", 200) + "*/ 1",
        repeated("[", 50) + repeated("]", 50) + repeated("[", 90)})
    EXPECT_EQ(fault_of_json_size(text), "") << text.substr(0, 40);
}

TEST(JsonSize, CountsNamesAndValues) {
  const JsonBounds few{.depth = 5, .names = 3, .values = 10, .bytes = 1000};
  EXPECT_EQ(fault_of_json_size(R"({"a": 1, "b": 2, "c": {"d": 3, "e": 4, "f": 5}})", few), "");
  EXPECT_NE(fault_of_json_size(R"({"a": 1, "b": 2, "c": 3, "d": 4})", few), "");
  EXPECT_NE(fault_of_json_size("[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]", few), "");
  EXPECT_NE(fault_of_json_size(std::string(2000, ' '), few), "");
}

TEST(JsonSize, EndsWithAnyText) {
  for (const char* text : {"", "\"", "\"\\", "/", "/*", "//", "]]]]", "}{", "\"\\\"", ":::"})
    EXPECT_EQ(fault_of_json_size(text), "") << text;
}

}  // namespace
}  // namespace acinus
