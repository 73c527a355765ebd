// The texts that the editor holds, and all others as their files have them.
#pragma once

#include "base/result.hpp"
#include "lsp/message.hpp"
#include "scene/load_options.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace tidemark::lsp {

struct Document {
    std::string uri; ///< as the editor spells it
    int version = 0;
};

class Documents {
public:
    void hold(const std::filesystem::path& file, Document document, std::string text);
    void release(const std::filesystem::path& file);

    /// nullptr: the editor does not hold it.
    const Document* find(const std::filesystem::path& file) const;
    /// Line ends are plain, whatever the editor's are: they count as one character each.
    Result<std::string> text_of(const std::filesystem::path& file) const;
    std::string uri_of(const std::filesystem::path& file) const;

    const scene::UnsavedTexts& texts() const { return texts_; }
    const std::map<std::filesystem::path, Document>& open() const { return open_; }

private:
    std::map<std::filesystem::path, Document> open_;
    scene::UnsavedTexts texts_;
};

/// The one name of a file, by which it is known here.
std::filesystem::path canonical_name(const std::filesystem::path& file);

} // namespace tidemark::lsp
