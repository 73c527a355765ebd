// Text in, text out: each tests/cases/glsl/<name>.glsl is loaded as a scene; <name>.expected holds what the
// driver gets, every line behind the place where it was written, or the error. Lines `//: --define A=1` and
// `//: --set k=2` of a case are options; the prologue is shown where a line `//: --prologue` asks for it.
#include "base/file.hpp"
#include "glsl/assemble.hpp"
#include "glsl/overrides.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace tidemark::glsl {
namespace {

namespace fs = std::filesystem;

const fs::path k_folder = fs::path(TIDEMARK_SOURCE_DIR) / "tests/cases/glsl";

std::vector<std::string> case_names() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(k_folder))
        if (entry.path().extension() == ".glsl")
            names.push_back(entry.path().stem());
    std::sort(names.begin(), names.end());
    return names;
}

struct Options {
    bool prologue = false;
    std::vector<std::pair<std::string, std::string>> settings; ///< option and value
};

Options options_of(const std::string& text) {
    Options options;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string mark, option, value;
        if (!(words >> mark >> option) || mark != "//:")
            continue;
        if (option == "--prologue")
            options.prologue = true;
        else if (std::getline(words >> std::ws, value))
            options.settings.emplace_back(option, value);
    }
    return options;
}

std::string listed(const ShaderSource& source, bool with_prologue) {
    std::string list;
    std::istringstream lines(source.text());
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        const SourceLocation where = source.lines().locate(++number);
        if (where.file.empty() && list.empty() && !with_prologue)
            continue;
        list += where.file.empty() ? "-" : where.file + ":" + std::to_string(where.line);
        list += line.empty() ? " |\n" : " | " + line + "\n";
    }
    return list;
}

std::string outcome(const std::string& file, const Options& options) {
    auto scene = scene::load_scene(file);
    if (!scene)
        return to_string(scene.error()) + "\n";
    for (const auto& [option, value] : options.settings) {
        const auto done =
            option == "--define" ? override_definition(*scene, value) : scene::override_knob(*scene, value);
        if (!done)
            return to_string(done.error()) + "\n";
    }
    std::string knobs;
    for (const scene::Knob& knob : scene->knobs)
        knobs += "knob " + knob.name + " = " + scene::to_string(knob) + "\n";
    return knobs + listed(assemble(*scene, scene->image()), options.prologue);
}

class GlslCase : public testing::TestWithParam<std::string> {};

TEST_P(GlslCase, gives_what_is_expected) {
    const fs::path before = fs::current_path();
    fs::current_path(k_folder);
    const std::string file = GetParam() + ".glsl";
    const auto text = read_file(file);
    const auto expected = read_file(GetParam() + ".expected");
    const std::string actual = outcome(file, options_of(text.value_or("")));
    fs::current_path(before);
    ASSERT_TRUE(expected) << expected.error().message << "; it would hold\n" << actual;
    EXPECT_EQ(actual, *expected);
}

INSTANTIATE_TEST_SUITE_P(Text, GlslCase, testing::ValuesIn(case_names()),
                         [](const auto& each) { return each.param; });

} // namespace
} // namespace tidemark::glsl
