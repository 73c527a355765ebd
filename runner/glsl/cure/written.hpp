// Nodes of a text that is read to its tree, back to where their author wrote them: what a cure is made of.
#pragma once

#include "glsl/cure/cure.hpp"
#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Tokens of a ParsedText, both ends included.
struct WrittenTokens {
    size_t first = 0, last = 0;
};

/// What is written for a node that is `operation` or a part of it. Where a macro's body says the operation it
/// is that body's tokens, and every use of the macro shares them. Nothing where they are not the author's, or
/// where the body says only a part of it.
std::optional<WrittenTokens> written_for(const ParsedText& text, NodeId id, NodeId operation);

Wrap wrapped(const ParsedText& text, WrittenTokens tokens, std::string front, std::string behind);
/// `instead` for them.
Wrap in_place_of(const ParsedText& text, WrittenTokens tokens, std::string instead);

/// Around one word; nothing where it is not its author's own, but a macro's.
std::optional<Wrap> at_word(const ParsedText& text, size_t word, std::string front, std::string behind);

/// k_no_node of a prototype.
NodeId body_of_function(const ParsedText& text, NodeId function);
std::vector<NodeId> parameters_of(const ParsedText& text, NodeId function);
/// Where it is defined; k_no_node: nowhere.
NodeId find_main_image(const ParsedText& text);

/// `wanted`, or that with a number, from `number` on: one that no word of the text has. 1 is not written.
std::string fresh_name(const ParsedText& text, std::string_view wanted, size_t number = 1);

/// The tokens of an expression, to be said once more: nothing where that would do something twice, or where
/// they are long.
std::optional<std::string> said_again(const ParsedText& text, const TreeFacts& facts, NodeId id,
                                      WrittenTokens tokens);

} // namespace tidemark::glsl
