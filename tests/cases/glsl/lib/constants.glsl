#ifndef PI
#define PI 3.14159265
#endif
