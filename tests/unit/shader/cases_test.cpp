// Text in, text out: each tests/cases/glsl/<name>.glsl is loaded as a scene; <name>.expected holds what the
// driver gets, every line after the place where it was written, or the error. Lines `//: --define A=1` and
// `//: --set k=2` of a case are options; the prologue is shown where a line `//: --prologue` asks for it.
// With `//: --precision double` (and `//: --double-hashes`) the text is promoted, and the functions that it
// calls of ours and the hashes that stay in floats are listed first.
#include "base/file.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"
#include "shader/definitions.hpp"
#include "shader/pass_reading.hpp"
#include "support/cases.hpp"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

namespace tidemark::glsl::cases_test {

namespace fs = std::filesystem;

const fs::path k_folder = fs::path(TIDEMARK_SOURCE_DIR) / "tests/cases/glsl";

struct Options {
    bool prologue = false;
    Precision precision = Precision::single;
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
        else if (option == "--precision")
            options.precision = Precision::promoted;
        else if (option == "--double-hashes")
            options.precision = Precision::promoted_whole;
        else if (std::getline(words >> std::ws, value))
            options.settings.emplace_back(option, value);
    }
    return options;
}

std::string listed(const text::MappedText& source, bool with_prologue) {
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

/// The functions of ours that a promoted text brings along, and the hashes.
std::string extras(const Assembly& assembly) {
    std::set<std::string> names;
    std::istringstream lines(assembly.source.text());
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        const bool ours = assembly.source.lines().locate(++number).file.empty();
        const size_t name = line.find(" tidemark_");
        if (ours && line.starts_with('d') && name < line.find('(') && line.find("{ return") != line.npos)
            names.insert(line.substr(name + 1, line.find('(') - name - 1));
    }
    std::string list;
    for (const std::string& name : names)
        list += "calls " + name + "\n";
    for (const KeptHash& hash : assembly.hashes)
        list += "float " + hash.function + " " + hash.where.file + ":" + std::to_string(hash.where.line) +
                " " + std::string(to_string(hash.kind)) + "\n";
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
    const PassReading reading(*scene, scene->image());
    const auto assembly = reading.assemble(reading.dialects(options.precision).front());
    if (!assembly)
        return to_string(assembly.error()) + "\n";
    return knobs + (options.precision == Precision::promoted ? extras(*assembly) : "") +
           listed(assembly->source, options.prologue);
}

class GlslCase : public testing::TestWithParam<std::string> {};

TEST_P(GlslCase, gives_the_expected_output) {
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

INSTANTIATE_TEST_SUITE_P(Text, GlslCase, testing::ValuesIn(case_names(k_folder)),
                         [](const auto& each) { return each.param; });

} // namespace tidemark::glsl::cases_test
