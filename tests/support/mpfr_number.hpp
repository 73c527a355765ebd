// A number of MPFR with 200 bits, for references that are exact as far as a double can tell.
#pragma once

#include <gtest/gtest.h>
#include <mpfr.h>

namespace tidemark {

class MpfrNumber {
public:
    explicit MpfrNumber(double value = 0) {
        mpfr_init2(value_, 200);
        mpfr_set_d(value_, value, MPFR_RNDN);
    }
    ~MpfrNumber() { mpfr_clear(value_); }
    MpfrNumber(const MpfrNumber&) = delete;
    MpfrNumber& operator=(const MpfrNumber&) = delete;
    mpfr_ptr get() { return value_; }
    double rounded() const { return mpfr_get_d(value_, MPFR_RNDN); }

private:
    mpfr_t value_;
};

/// Constants that MPFR keeps for later would be leaks to the sanitizer.
class MpfrCache : public testing::Environment {
public:
    void TearDown() override { mpfr_free_cache(); }
};

inline testing::Environment* const k_mpfr_cache = testing::AddGlobalTestEnvironment(new MpfrCache);

} // namespace tidemark
