#include <sks_detector/DetectionArray.h>
