#include "scene/json_text.hpp"
#include "scene/project_exchange.hpp"

#include <gmock/gmock.h>

#include <string>

namespace tidemark::scene::saved_project_test {

using testing::ElementsAre;

const std::string k_project = R"({"ver":"0.1","info":{"id":"abCD12","description":"a \"brace\" { and ]"},)"
                              R"("renderpass":[{"type":"image","code":"if (a < b && c) {\n}"}]})";

/// As a page has it where quotes and the like are marks.
std::string with_entities(std::string text) {
    for (const auto& [from, to] :
         {std::pair("&", "&amp;"), std::pair("<", "&lt;"), std::pair(">", "&gt;"), std::pair("\"", "&quot;")})
        for (size_t at = 0; (at = text.find(from, at)) != text.npos; at += std::string(to).size())
            text.replace(at, 1, to);
    return text;
}

std::string error_of(const Result<std::string>& result) {
    return result ? "no error" : to_string(result.error());
}

TEST(PageJson, is_found_anywhere_in_a_script) {
    for (const char* before :
         {"", "var q = '\"'; f(function() { return [{", "var info = {\"a\": {}};\n", "{{{{[[["})
        EXPECT_THAT(projects_in_page("<html><SCRIPT type=x>" + std::string(before) + "var gRes = [" +
                                     k_project + "];</SCRIPT>"),
                    ElementsAre(k_project))
            << before;
}

TEST(PageJson, is_found_in_text_and_attributes) {
    const std::string shown = "<html><body><pre>" + with_entities(k_project) + "</pre></body></html>";
    EXPECT_THAT(projects_in_page(shown), ElementsAre(k_project));
    const std::string attribute =
        R"(<div class="player" data-shader=")" + with_entities(k_project) + "\"></div>";
    EXPECT_THAT(projects_in_page(attribute), ElementsAre(k_project));
}

TEST(PageJson, is_not_taken_from_half_a_page_or_from_a_string) {
    EXPECT_THAT(projects_in_page("<script>" + k_project.substr(0, k_project.size() - 1)), ElementsAre());
    EXPECT_THAT(projects_in_page(R"(<script>x = {"a": "say \"renderpass\" {"}</script>)"), ElementsAre());
    EXPECT_THAT(projects_in_page("<p>\"renderpass\"</p>"), ElementsAre());
    EXPECT_THAT(projects_in_page("<"), ElementsAre());
}

TEST(PageJson, a_hostile_page_takes_linear_time) {
    std::string braces(size_t{4} << 20, '{');
    for (int i = 0; i < 100; ++i)
        braces += "\"renderpass\"";
    EXPECT_THAT(projects_in_page("<script>" + braces), ElementsAre());
}

TEST(SavedProject, json_is_unchanged_without_a_selection) {
    EXPECT_EQ(*saved_project(" [ 1 ] ", "", "x.json"), " [ 1 ] ");
}

TEST(SavedProject, a_project_of_several_is_selected_by_id) {
    const std::string other = R"({"info":{"id":"other1"},"renderpass":[{"code":"o"}]})";
    for (const std::string& list :
         {"[" + other + "," + k_project + "]", "{\"shaders\":[" + other + "," + k_project + "]}",
          "[{\"Shader\":" + other + "},{\"Shader\":" + k_project + "}]",
          "<script>" + other + ";" + k_project + "</script>"}) {
        const auto chosen = saved_project(list, "abCD12", "x");
        ASSERT_TRUE(chosen) << error_of(chosen) << list;
        EXPECT_NE(chosen->find("brace"), chosen->npos);
        EXPECT_EQ(chosen->find("other1"), chosen->npos);
        EXPECT_EQ(error_of(saved_project(list, "nobody", "x")),
                  "x: error: this holds other1, abCD12, but not nobody");
    }
    EXPECT_EQ(error_of(saved_project("<script>" + other + ";" + k_project + "</script>", "", "x")),
              "x: error: this holds 2 projects (other1, abCD12): choose one with `import ID --via FILE`");
}

TEST(SavedProject, a_project_without_an_id_is_accepted) {
    const std::string passes = R"([{"type":"image","code":"c"}])";
    EXPECT_EQ(parse_json(*saved_project(passes, "abCD12", "x"), "x").value(),
              parse_json(passes, "x").value());
    EXPECT_EQ(error_of(saved_project(k_project, "other1", "x")),
              "x: error: this holds abCD12, but not other1");
}

TEST(SavedProject, an_address_ends_with_the_id) {
    for (const char* address :
         {"abCD12", "https://www.shadertoy.com/view/abCD12", "shadertoy.com/view/abCD12/",
          "https://www.shadertoy.com/embed/abCD12?gui=true&t=10",
          "https://www.shadertoy.com/api/v1/shaders/abCD12?key=KEY#top"})
        EXPECT_EQ(*project_id(address), "abCD12") << address;
    for (const char* address : {"", "-rf/12", "abCD1", "abCD123", "https://www.shadertoy.com/", "ab CD1",
                                "abCD1\xc3", "https://example.com/view/abCD12", "example.com/abCD12",
                                "https://example.com/www.shadertoy.com/abCD12"})
        EXPECT_FALSE(project_id(address)) << address;
}

} // namespace tidemark::scene::saved_project_test
