// Messages of the language server protocol: JSON-RPC 2.0, each with a header that gives its length.
#pragma once

#include "base/error.hpp"
#include "scene/load_scene.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

// Positions in the protocol's form: lines from 0, characters in the encoding that was agreed on.

enum class Encoding { utf8, utf16 };

/// The line starts of a text, for any number of conversions. The text must outlive it.
class Lines {
public:
    Lines(std::string_view text, Encoding encoding);

    /// Returns the position of an offset, which is clamped to the text.
    Json position(size_t offset) const;
    Json range(size_t begin, size_t end) const;
    /// Returns the offset of a position, clamped to the text.
    size_t offset(const Json& position) const;
    /// Return the offsets where a line (from 1) begins and where it ends, without its line end.
    size_t begin_of(int line) const;
    size_t end_of(int line) const;

private:
    std::string_view text_;
    Encoding encoding_;
    std::vector<size_t> begins_;
};

// The texts that the editor holds; all other texts come from their files.

struct Document {
    std::string uri; ///< as the editor spells it
    int version = 0;
};

class Documents {
public:
    void hold(const std::filesystem::path& file, Document document, std::string text);
    void release(const std::filesystem::path& file);

    /// Returns nullptr if the editor does not hold the file.
    const Document* find(const std::filesystem::path& file) const;
    /// Returns the text with every line end as one `\n`, so that offsets do not depend on the editor.
    Result<std::string> text_of(const std::filesystem::path& file) const;
    std::string uri_of(const std::filesystem::path& file) const;

    const scene::UnsavedTexts& texts() const { return texts_; }
    const std::map<std::filesystem::path, Document>& open() const { return open_; }

private:
    std::map<std::filesystem::path, Document> open_;
    scene::UnsavedTexts texts_;
};

/// Returns the one path under which a file is stored here.
std::filesystem::path canonical_name(const std::filesystem::path& file);

} // namespace tidemark::lsp
