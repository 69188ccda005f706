#include <myolines/pch.h>
