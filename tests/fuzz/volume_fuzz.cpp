// ShaderToy's `.bin` volume.
#include "fuzz.hpp"
#include "media/texture_files.hpp"

using namespace tidemark;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view file = text_of(data, size);
    const Result<image::VolumeData> volume = image::volume_of(file, "v.bin");
    if (!volume) {
        REQUIRE(!volume.error().message.empty());
        return 0;
    }
    REQUIRE(volume->bytes.size() == volume->samples() * image::size_of(volume->type));
    REQUIRE(volume->bytes.size() + 20 == size);
    return 0;
}
