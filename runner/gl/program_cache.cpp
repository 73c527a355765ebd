#include "gl/program_cache.hpp"

#include "base/file_cache.hpp"
#include "base/hash.hpp"
#include "gl/capabilities.hpp"

#include <cstring>
#include <optional>

namespace tidemark::gl {
namespace {

/// Room for some thousand programs.
constexpr uint64_t k_most_bytes = uint64_t{64} << 20;

bool has_binaries() {
    GLint formats = 0;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    return formats > 0;
}

/// Hashes all that determines the binary: our version, the driver and the two texts.
std::string key_of(std::string_view vertex, std::string_view fragment) {
    const Capabilities driver = query_capabilities();
    std::string all;
    for (const std::string_view part :
         {std::string_view(TIDEMARK_VERSION), std::string_view(driver.vendor),
          std::string_view(driver.renderer), std::string_view(driver.version), vertex, fragment}) {
        all += part;
        all += '\0'; // does not occur in a part
    }
    return sha256(std::as_bytes(std::span(all)));
}

std::optional<Program> recalled(const std::optional<std::string>& kept) {
    ProgramBinary binary;
    if (!kept || kept->size() <= sizeof binary.format)
        return std::nullopt;
    std::memcpy(&binary.format, kept->data(), sizeof binary.format);
    binary.bytes = kept->substr(sizeof binary.format);
    return Program::load(binary);
}

} // namespace

tl::expected<Program, std::string> link_or_recall(std::string_view vertex, std::string_view fragment) {
    const auto folder = user_cache_folder();
    if (!folder || !has_binaries())
        return Program::link(vertex, fragment);
    const FileCache cache(*folder / "programs", k_most_bytes);
    const std::string key = key_of(vertex, fragment);
    if (auto program = recalled(cache.find(key)))
        return *std::move(program);
    auto program = Program::link(vertex, fragment);
    if (!program)
        return program;
    if (const ProgramBinary binary = program->binary(); !binary.bytes.empty()) {
        const std::string_view format(reinterpret_cast<const char*>(&binary.format), sizeof binary.format);
        cache.keep(key, std::string(format).append(binary.bytes));
    }
    return program;
}

} // namespace tidemark::gl
