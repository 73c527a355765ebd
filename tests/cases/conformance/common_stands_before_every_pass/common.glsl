const int first_line = __LINE__;
const float shared_value = 6.0;
float twice(float x) { return 2.0 * x; }
