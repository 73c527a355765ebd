// Requests of an editor about a place in a document, by the protocol's method names.
#pragma once

#include "editor/workspace.hpp"

#include <tl/expected.hpp>

#include <string>
#include <string_view>

namespace tidemark::lsp {

/// The reason why a request fails.
struct Refusal {
    ErrorNumber number;
    std::string message;
};
using Answer = tl::expected<Json, Refusal>;

tl::unexpected<Refusal> refuse(ErrorNumber number, std::string message);

/// A request. `workspace` is that of the document. All references must outlive it.
struct Question {
    const Workspace& workspace;
    const Json& params;
    const Documents& documents;
    Encoding encoding;

    /// Returns the offset of the position in the request.
    size_t offset() const;
};

using AnswerTo = Answer (*)(const Question&);
/// Returns nullptr for an unknown method. The returned function throws Json::exception where a parameter is
/// missing.
AnswerTo find_question(std::string_view method);

} // namespace tidemark::lsp
