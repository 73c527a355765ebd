#include "scene/channel_input.hpp"

namespace tidemark::scene {
namespace {

template <class Input>
auto* pass_of(Input& input) {
    return std::visit(
        [](auto& kind) -> decltype(source_pass(input)) {
            if constexpr (k_traits<std::decay_t<decltype(kind)>>.from == ReadsFrom::pass)
                return &kind.pass;
            else
                return nullptr;
        },
        input);
}

} // namespace

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
    return pass_of(input);
}

size_t* source_pass(ChannelInput& input) {
    return pass_of(input);
}

} // namespace tidemark::scene
