// Helpers of the sound tests: a folder of their own and sounds to analyse and to write.
#pragma once

#include "media/sound_file.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sndfile.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

namespace tidemark::sound {

namespace fs = std::filesystem;

/// A fresh folder that goes with the test.
class SoundTest : public testing::Test {
protected:
    fs::path in_folder(const std::string& name) const { return folder_ / name; }
    fs::path put(const std::string& name, const std::string& bytes) const {
        std::ofstream(in_folder(name), std::ios::binary | std::ios::trunc) << bytes;
        return in_folder(name);
    }

private:
    TemporaryFolder folder_;
};

inline SoundData sine(double hertz, double amplitude, double seconds, int rate = 44100, int channels = 1) {
    SoundData sound{rate, channels, {}};
    for (int n = 0; n < int(seconds * rate); ++n)
        for (int channel = 0; channel < channels; ++channel)
            sound.samples.push_back(float(amplitude * std::sin(2.0 * std::numbers::pi * hertz * n / rate)));
    return sound;
}

/// Through libsndfile's encoder; `format` as in its SF_INFO.
inline fs::path write_encoded(const fs::path& path, const SoundData& sound, int format) {
    SF_INFO info{};
    info.samplerate = sound.rate;
    info.channels = sound.channels;
    info.format = format;
    SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
    if (!file) {
        ADD_FAILURE() << sf_strerror(nullptr);
        return path;
    }
    sf_writef_float(file, sound.samples.data(), sf_count_t(sound.frames()));
    sf_close(file);
    return path;
}

} // namespace tidemark::sound
