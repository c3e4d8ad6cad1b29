/* Read before what is generated, so that all its numbers are in single precision; its constants are by -fsingle-precision-constant. */
#include <math.h>

#define double float
#define cos cosf
#define fabs fabsf
#define pow powf
#define sin sinf
#define sqrt sqrtf
