// Does with projects what the program does before a driver sees them: reads them, rewrites them in every way
// that it has, and compiles them with glslang. Reads one path a line from standard input and prints a line of
// JSON for each; load_projects.py runs it.
#include "scene/load_scene.hpp"
#include "shader/pass_reading.hpp"
#include "shader/specialise.hpp"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <nlohmann/json.hpp>

#include <ctime>
#include <iostream>
#include <optional>
#include <string>

namespace {

using namespace tidemark;
using Json = nlohmann::ordered_json;

/// Milliseconds of the CPU for each kind of work, and what the project fails by.
struct Outcome {
    double load = 0, rewrite = 0, compile = 0;
    size_t passes = 0, promoted = 0;
    std::string stage{}, message{};
};

/// Adds to a sum of milliseconds what `work` takes.
auto timed(double& sum, const auto& work) {
    const std::clock_t begin = std::clock();
    auto result = work();
    sum += 1e3 * double(std::clock() - begin) / CLOCKS_PER_SEC;
    return result;
}

/// Its first error; empty: none.
std::string refusal(const std::string& text) {
    glslang::TShader shader(EShLangFragment);
    const char* const strings[] = {text.c_str()};
    shader.setStrings(strings, 1);
    std::string log;
    if (shader.parse(GetDefaultResources(), 110, false, EShMsgDefault)) {
        glslang::TProgram program;
        program.addShader(&shader);
        if (program.link(EShMsgDefault))
            return {};
        log = program.getInfoLog();
    } else {
        log = shader.getInfoLog();
    }
    const size_t error = log.find("ERROR");
    log.erase(0, error == std::string::npos ? 0 : error);
    return log.empty() ? "no reason given" : log.substr(0, log.find('\n'));
}

/// As the driver is offered it: the first dialect that compiles, without what a scene does not need and with
/// it. The error is the first dialect's.
std::string compile(const glsl::PassReading& reading, const scene::Scene& scene, Outcome& outcome) {
    std::string first;
    for (const glsl::Dialect& dialect : reading.dialects(glsl::Precision::single)) {
        const auto assembly = timed(outcome.rewrite, [&] { return reading.assemble(dialect); });
        if (!assembly)
            return to_string(assembly.error());
        const std::string error = timed(outcome.compile, [&] { return refusal(assembly->source.text()); });
        if (first.empty())
            first = error;
        if (!error.empty())
            continue;
        const auto special = timed(outcome.rewrite, [&] {
            return glsl::specialise(assembly->source, scene.knobs, glsl::Specialise::constants);
        });
        const std::string shorter = timed(outcome.compile, [&] { return refusal(special.source.text()); });
        return shorter.empty() ? shorter : "specialised: " + shorter;
    }
    return first;
}

/// Whether a text of doubles can be had.
bool promotes(const glsl::PassReading& reading, Outcome& outcome) {
    for (const glsl::Dialect& dialect : reading.dialects(glsl::Precision::promoted)) {
        const auto assembly = timed(outcome.rewrite, [&] { return reading.assemble(dialect); });
        if (assembly && timed(outcome.compile, [&] { return refusal(assembly->source.text()); }).empty())
            return true;
    }
    return false;
}

Outcome look_at(const std::string& path) {
    Outcome outcome;
    const auto scene = timed(outcome.load, [&] { return scene::load_scene(path); });
    if (!scene) {
        outcome.stage = "load";
        outcome.message = to_string(scene.error());
        return outcome;
    }
    for (const scene::Pass& pass : scene->passes) {
        ++outcome.passes;
        const glsl::PassReading reading(*scene, pass);
        const std::string error = compile(reading, *scene, outcome);
        if (error.empty()) {
            outcome.promoted += promotes(reading, outcome);
        } else if (outcome.stage.empty()) {
            outcome.stage = "compile";
            outcome.message = pass.name + ": " + error;
        }
    }
    return outcome;
}

} // namespace

int main() {
    glslang::InitializeProcess();
    for (std::string path; std::getline(std::cin, path);) {
        const Outcome outcome = look_at(path);
        const Json line{{"project", path},
                        {"stage", outcome.stage},
                        {"message", outcome.message},
                        {"passes", outcome.passes},
                        {"promoted", outcome.promoted},
                        {"milliseconds", {outcome.load, outcome.rewrite, outcome.compile}}};
        std::cout << line.dump(-1, ' ', false, Json::error_handler_t::replace) << std::endl;
    }
    glslang::FinalizeProcess();
}
