#include "scene/pass_names.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::scene {
namespace {

using Kind = PassName::Kind;

constexpr int k_letters = 26;

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
}

} // namespace

std::optional<PassName> parse_pass_name(std::string_view name) {
    std::string plain;
    for (const char c : name)
        if (c != ' ' && c != '_' && c != '-')
            plain += lower(c);
    constexpr std::pair<std::string_view, Kind> k_words[] = {
        {"image", Kind::image},     {"common", Kind::common}, {"sound", Kind::sound},
        {"cube", Kind::cubemap},    {"cubea", Kind::cubemap}, {"cubemap", Kind::cubemap},
        {"cubemapa", Kind::cubemap}};
    for (const auto& [word, kind] : k_words)
        if (plain == word)
            return PassName{kind, 0};
    for (const std::string_view word : {"buffer", "buf"})
        if (plain.size() == word.size() + 1 && plain.starts_with(word) && plain.back() >= 'a' &&
            plain.back() <= 'd')
            return PassName{Kind::buffer, plain.back() - 'a'};
    return std::nullopt;
}

std::string buffer_name(int number) {
    return number < k_letters ? fmt::format("Buffer {}", char('A' + number))
                              : fmt::format("Buffer {}", number + 1);
}

std::string to_string(const PassName& name) {
    switch (name.kind) {
    case Kind::common: return "Common";
    case Kind::buffer: return buffer_name(name.number);
    case Kind::cubemap: return "Cube A";
    case Kind::sound: return "Sound";
    case Kind::image: break;
    }
    return "Image";
}

std::string file_name_of(std::string_view pass_name) {
    std::string file;
    for (const char c : pass_name)
        file += c == ' ' ? '_' : lower(c);
    return file + ".glsl";
}

bool is_shader_file(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), lower);
    return extension == ".glsl" || extension == ".frag" || extension == ".fs" || extension == ".txt";
}

} // namespace tidemark::scene
