#include "cli/inspect/driver_code.hpp"

#include "cli/json_dump.hpp"
#include "gl/compiler_messages.hpp"
#include "platform/driver_cache.hpp"
#include "render/link_pass.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>

namespace tidemark::cli {
namespace {

using glsl::Specialise;

constexpr const char* k_cache_variable = "MESA_SHADER_CACHE_DIR";

const DriverCode& of(const CompiledSizes& sizes, Specialise how) {
    return sizes[size_t(how)];
}

/// The program is deleted on return: a driver that still has an equal one would not compile the next.
std::optional<DriverCode> code_of(const scene::Scene& scene, const scene::Pass& pass,
                                  glsl::Precision precision, Specialise how) {
    gl::CompilerMessages messages;
    const auto linked = render::link_pass(scene, pass, {precision, how});
    if (!linked)
        return std::nullopt;
    DriverCode code{linked->program.binary().bytes.size()};
    for (const std::string& message : messages.take())
        if (auto count = glsl::read_instruction_count(message))
            code.instructions.push_back(*std::move(count));
    return code;
}

std::optional<CompiledSizes> sizes_of(const scene::Scene& scene, const scene::Pass& pass,
                                      glsl::Precision precision) {
    CompiledSizes sizes;
    for (size_t i = 0; i < sizes.size(); ++i) {
        auto code = code_of(scene, pass, precision, Specialise(i));
        if (!code)
            return std::nullopt;
        // A driver that reported counts before and reports none now reuses code that it compiled before.
        if (code->instructions.empty() && i > 0)
            code->instructions = sizes[i - 1].instructions;
        sizes[i] = *std::move(code);
    }
    return sizes;
}

Json code_json(const DriverCode& code) {
    Json instructions = Json::object();
    for (const auto& [shader, count] : code.instructions)
        instructions[shader] = count;
    return {{"bytes", code.bytes ? Json(code.bytes) : Json()}, {"instructions", instructions}};
}

std::string counts_of(const DriverCode& code) {
    std::vector<std::string> counts;
    for (const auto& [shader, count] : code.instructions)
        counts.push_back(fmt::format("{} {}", shader, count));
    return fmt::format("{}", fmt::join(counts, ", "));
}

std::string bytes_of(const DriverCode& code) {
    return fmt::format("{}", code.bytes);
}

/// Formats one figure of the four levels as a line.
std::string to_line(std::string_view what, const CompiledSizes& sizes,
                    std::string (*figure)(const DriverCode&)) {
    return fmt::format(
        "  {}: {}; of the whole text {}, in a long sequence {}, with constant knobs {}\n", what,
        figure(of(sizes, Specialise::unreachable)), figure(of(sizes, Specialise::nothing)),
        figure(of(sizes, Specialise::invariant_uniforms)), figure(of(sizes, Specialise::constants)));
}

} // namespace

FreshDriverCache::FreshDriverCache() {
    if (folder_.path().empty())
        return;
    ::setenv(k_cache_variable, folder_.path().c_str(), 1);
    platform::do_without_full_driver_cache();
}

std::vector<std::optional<CompiledSizes>> compiled_sizes(const scene::Scene& scene,
                                                         glsl::Precision precision) {
    std::vector<std::optional<CompiledSizes>> sizes;
    for (const scene::Pass& pass : scene.passes)
        sizes.push_back(pass.kind == scene::PassKind::sound ? std::nullopt
                                                            : sizes_of(scene, pass, precision));
    return sizes;
}

std::string to_lines(const CompiledSizes& sizes) {
    std::string text;
    if (sizes.front().bytes > 0)
        text += to_line("bytes of program", sizes, bytes_of);
    if (!sizes.front().instructions.empty())
        text += to_line("instructions", sizes, counts_of);
    return text;
}

Json to_json(const CompiledSizes& sizes) {
    return {{"plain", code_json(of(sizes, Specialise::nothing))},
            {"specialised", code_json(of(sizes, Specialise::unreachable))},
            {"long_sequence", code_json(of(sizes, Specialise::invariant_uniforms))},
            {"constant_knobs", code_json(of(sizes, Specialise::constants))}};
}

} // namespace tidemark::cli
