// What an editor asks about a place in a document, by the names of the protocol's methods.
#pragma once

#include "lsp/workspace.hpp"

#include <tl/expected.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::lsp {

/// Why a request is refused.
struct Refusal {
    ErrorNumber number;
    std::string message;
};
using Answer = tl::expected<Json, Refusal>;

tl::unexpected<Refusal> refuse(ErrorNumber number, std::string message);

/// `workspace` is that of the document. All must live as long.
struct Question {
    const Workspace& workspace;
    const Json& params;
    const Documents& documents;
    Encoding encoding;

    /// Of the position that is asked about.
    size_t offset() const;
};

using AnswerTo = Answer (*)(const Question&);
/// nullptr: there is no such question. Answers throw Json::exception where a parameter is missing.
AnswerTo find_question(std::string_view method);

} // namespace tidemark::lsp
