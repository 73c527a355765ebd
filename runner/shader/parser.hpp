// Implementation of parse(). Never throws and always ends: the first error moves the parser to the end of the
// text, where every rule returns.
#pragma once

#include "shader/parsed_text.hpp"

#include <initializer_list>
#include <optional>
#include <span>

namespace tidemark::glsl {

class Parser {
public:
    Parser(const std::vector<Word>& words, const std::vector<text::Token>& tokens, const text::LineMap& lines)
        : words_(words), tokens_(tokens), lines_(lines), end_(words.size()) {
        tree_.nodes.resize(1);
        tree_.nodes.reserve(words.size() + 1);
    }

    Result<SyntaxTree> run();

private:
    /// Counts the depth of nested rules, and fails beyond k_most_nesting.
    class Nesting {
    public:
        Nesting(Parser& parser, int weight) : parser_(parser), weight_(weight) {
            if ((parser_.nesting_ += weight_) > k_most_nesting)
                parser_.give_up("this is nested too deeply to analyse");
        }
        ~Nesting() { parser_.nesting_ -= weight_; }
        Nesting(const Nesting&) = delete;
        Nesting& operator=(const Nesting&) = delete;

    private:
        Parser& parser_;
        int weight_;
    };
    /// Counted in links of a chain of `?:` or `else if`; one level of parentheses counts as four.
    static constexpr int k_most_nesting = 1800;

    // Tokens.
    bool done() const { return at_ >= end_; }
    const Word& peek(size_t ahead = 0) const;
    bool at(std::string_view text) const { return peek().is(text); }
    bool at_name(size_t ahead = 0) const;
    bool take(std::string_view text);
    void expect(std::string_view text);
    void give_up(std::string_view message);
    /// Returns the index after the bracket that closes the one at `from`; end_ if none does.
    size_t behind_brackets(size_t from) const;
    void skip_brackets();

    // Nodes. A node's words end at the parser's current position.
    NodeId make(NodeKind kind, size_t begin, size_t word, std::span<const NodeId> children);
    NodeId make(NodeKind kind, size_t begin, size_t word, std::initializer_list<NodeId> children) {
        return make(kind, begin, word, std::span(children.begin(), children.size()));
    }
    NodeId absent() { return make(NodeKind::absent, at_, at_, {}); }
    void adopt(NodeId parent, std::span<const NodeId> children);

    // Expressions.
    NodeId expression(); ///< commas included
    NodeId assignment();
    NodeId conditional();
    NodeId binary(int rank);
    NodeId unary();
    NodeId postfix();
    NodeId primary();
    NodeId call(NodeId callee, size_t begin);
    NodeId brackets(std::optional<NodeId> what, size_t begin);
    NodeId initialiser();

    // Statements.
    NodeId statement();
    NodeId keyword_statement();
    NodeId block();
    NodeId if_else();
    NodeId for_loop();
    NodeId while_loop();
    NodeId do_loop();
    NodeId switch_on();
    NodeId label();
    NodeId condition();

    // Declarations.
    bool begins_declaration() const;
    bool at_qualifier() const;
    NodeId type();
    NodeId structure();
    NodeId declaration(NodeId type, size_t begin); ///< starts at the first declarator; does not consume `;`
    NodeId declarator();
    NodeId function(NodeId type, size_t begin);
    NodeId parameter();
    NodeId global();

    const std::vector<Word>& words_;
    const std::vector<text::Token>& tokens_;
    const text::LineMap& lines_;
    SyntaxTree tree_;
    std::optional<Error> error_;
    size_t at_ = 0;
    size_t end_;
    int nesting_ = 0;
};

/// Returns whether the keyword begins or separates statements, so that it cannot be a name.
bool is_statement_keyword(std::string_view word);

} // namespace tidemark::glsl
