// Any text read to its tree and watched: an error that says something, or a text that is watched again
// without one, as often as one likes.
#include "fuzz.hpp"
#include "shader/undefined_behaviour.hpp"
#include "shader/watch.hpp"

using namespace tidemark;

namespace {

Result<std::unique_ptr<const glsl::ParsedText>> read(std::string_view text) {
    text::MappedText source;
    source.append(text, "a.glsl", 1);
    return glsl::ParsedText::read(std::move(source), {});
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const auto parsed = read(text_of(data, size));
    if (!parsed) {
        REQUIRE(!to_string(parsed.error()).empty());
        return 0;
    }
    const glsl::SyntaxTree& tree = (*parsed)->tree();
    for (glsl::NodeId id = 1; id < tree.nodes.size(); ++id) {
        REQUIRE(tree[id].begin <= tree[id].end && tree[id].end <= (*parsed)->words().size());
        REQUIRE(tree[id].first_child < id);
    }
    const glsl::TreeFacts facts = glsl::find_facts(**parsed);
    glsl::WatchRequest request;
    request.reach = glsl::WatchRequest::Reach::everything;
    for (glsl::NodeId id = 1; id < tree.nodes.size(); ++id)
        if (glsl::is_float_operation(**parsed, facts, id)) {
            request.capture = id;
            break;
        }
    const glsl::Watch watch = glsl::watch(**parsed, facts, request);
    REQUIRE(watch.operands.size() <= glsl::WatchLayout::k_most_operands);
    REQUIRE(watch.loops.size() <= glsl::WatchLayout::k_most_loops);
    REQUIRE(!watch.text.empty());
    return 0;
}
