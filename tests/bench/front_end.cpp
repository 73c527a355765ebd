// Measures the work on a scene's text before the driver sees it: reading the file, directives, rewriting. The
// times are listed by size, so that a cost that grows faster than the text shows.
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"
#include "shader/pass_reading.hpp"

#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>

namespace {

using namespace tidemark;

/// Functions that call each other, in that many bytes; with what the rewriting looks for.
std::string text_of_size(size_t bytes) {
    std::string text = "#define STEPS 8\n#iUniform float height = 0.5 in { 0.0, 2.0 }\n"
                       "float wave0(vec2 p) { return sin(p.x + iTime); }\n";
    int count = 1;
    for (; text.size() < bytes; ++count) {
        const std::string name = "wave" + std::to_string(count);
        text += "float " + name +
                "(vec2 p) {\n    // a sum of waves, as authors write them\n    float sum;\n"
                "    for (int i = 0; i < STEPS; i++)\n        sum += wave" +
                std::to_string(count - 1) +
                "(p * 1.7 + float(i)) * texture2D(iChannel0, p).r;\n    return height * sum;\n}\n";
    }
    return text + "void mainImage(out vec4 color, in vec2 place) { color = vec4(wave" +
           std::to_string(count - 1) + "(place / iResolution.xy)); }\n";
}

void front_end(benchmark::State& state) {
    const std::string text = text_of_size(size_t(state.range(0)) * 1000);
    const auto file = std::filesystem::temp_directory_path() /
                      ("tidemark_front_end_" + std::to_string(state.range(0)) + ".glsl");
    std::ofstream(file) << text;
    for (auto _ : state) {
        const auto scene = scene::load_scene(file);
        const glsl::PassReading reading(*scene, scene->passes[0]);
        auto assembly = reading.assemble(reading.dialects(glsl::Precision::single).front());
        if (!assembly)
            state.SkipWithError("the text does not assemble");
        benchmark::DoNotOptimize(assembly);
    }
    std::filesystem::remove(file);
    state.SetBytesProcessed(int64_t(state.iterations()) * int64_t(text.size()));
    state.SetComplexityN(state.range(0));
}

BENCHMARK(front_end)
    ->Arg(5)
    ->Arg(50)
    ->Arg(500)
    ->Arg(1400)
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oN);

} // namespace
