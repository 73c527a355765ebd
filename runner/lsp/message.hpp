// Messages of the language server protocol: JSON-RPC 2.0, each with a header that gives its length.
#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::lsp {

using Json = nlohmann::json;

/// Error codes of JSON-RPC and of the language server protocol.
enum class ErrorNumber {
    parse_error = -32700,
    invalid_request = -32600,
    method_not_found = -32601,
    invalid_params = -32602,
    not_initialized = -32002,
    request_failed = -32803,
};

/// Returns the message with its header. Replaces bytes that are not valid UTF-8.
std::string framed(const Json& message);

Json response(const Json& id, Json result);
Json error_response(const Json& id, ErrorNumber number, std::string_view message);
Json notification(std::string_view method, Json params);

/// Splits the input stream into messages.
class MessageReader {
public:
    void feed(std::string_view bytes) { bytes_ += bytes; }
    /// Returns the next whole message, which need not be valid JSON; nothing until more bytes arrive.
    std::optional<std::string> next();
    /// Returns whether a header was not valid: the next message cannot be found then.
    bool broken() const { return broken_; }

private:
    std::string bytes_;
    bool broken_ = false;
};

} // namespace tidemark::lsp
