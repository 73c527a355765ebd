// Maps nodes of a parsed text back to the author's tokens, and builds edits of them. Does not apply the
// edits.
#pragma once

#include "glsl/cure/cure.hpp"
#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// A range of tokens of a ParsedText, both ends included.
struct WrittenTokens {
    size_t first = 0, last = 0;
};

/// Returns the tokens written for a node that is `operation` or a part of it. If a macro's body contains the
/// operation, the tokens are those of the body, which every use of the macro shares. Returns nothing if the
/// tokens are not the author's, or if the body contains only a part of the node.
std::optional<WrittenTokens> written_for(const ParsedText& text, NodeId id, NodeId operation);

Wrap wrapped(const ParsedText& text, WrittenTokens tokens, std::string front, std::string behind);
/// Replaces the tokens by `instead`.
Wrap in_place_of(const ParsedText& text, WrittenTokens tokens, std::string instead);

/// Wraps one token; nothing if it comes from a macro or is not the author's.
std::optional<Wrap> at_word(const ParsedText& text, size_t word, std::string front, std::string behind);

/// Returns the function's block; k_no_node for a prototype.
NodeId body_of_function(const ParsedText& text, NodeId function);
std::vector<NodeId> parameters_of(const ParsedText& text, NodeId function);
/// Returns the definition of mainImage; k_no_node: none.
NodeId find_main_image(const ParsedText& text);

/// Returns `wanted` followed by a number, the first from `number` on that the text does not use; 1 is not
/// written.
std::string fresh_name(const ParsedText& text, std::string_view wanted, size_t number = 1);

/// Returns the text of an expression to repeat it: nothing if evaluating it twice has side effects, or if it
/// is long or not on one line.
std::optional<std::string> said_again(const ParsedText& text, const TreeFacts& facts, NodeId id,
                                      WrittenTokens tokens);

} // namespace tidemark::glsl
