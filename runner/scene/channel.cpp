#include "scene/channel.hpp"

#include <utility>

namespace tidemark::scene {
namespace {

constexpr std::string_view k_microphone = "microphone";
constexpr std::string_view k_webcam = "webcam";

} // namespace

std::optional<ChannelInput> generated_input(std::string_view name) {
    // Without a file these are the live microphone and webcam, if the user turned them on.
    if (name == k_microphone)
        return Music{};
    if (name == k_webcam)
        return Video{};
    std::optional<ChannelInput> found;
    const auto offer = [&]<class Kind>(std::type_identity<Kind>) {
        if (k_traits<Kind>.by_name && k_traits<Kind>.name == name)
            found = Kind{};
    };
    [&]<class... Kinds>(std::type_identity<std::variant<Kinds...>>) {
        (offer(std::type_identity<Kinds>()), ...);
    }(std::type_identity<ChannelInput>());
    return found;
}

std::span<const std::filesystem::path> input_files(const ChannelInput& input) {
    return std::visit(
        []<class Kind>(const Kind& kind) -> std::span<const std::filesystem::path> {
            if constexpr (k_traits<Kind>.from == ReadsFrom::file)
                return {&kind.file, kind.file.empty() ? size_t(0) : size_t(1)};
            else if constexpr (k_traits<Kind>.from == ReadsFrom::files)
                return kind.files;
            else
                return {};
        },
        input);
}

const size_t* source_pass(const ChannelInput& input) {
    return std::visit(
        []<class Kind>(const Kind& kind) -> const size_t* {
            if constexpr (k_traits<Kind>.from == ReadsFrom::pass)
                return &kind.pass;
            else
                return nullptr;
        },
        input);
}

size_t* source_pass(ChannelInput& input) {
    return const_cast<size_t*>(source_pass(std::as_const(input)));
}

} // namespace tidemark::scene
