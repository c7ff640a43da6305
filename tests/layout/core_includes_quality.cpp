// Against the direction of the rooms: what is compiled as a part of core must not find this.
#include "antigrasp/quality/epsilon.h"
