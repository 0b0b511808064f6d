# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2034
#
# Sourced by tests that tell libraries that the processor has less than it has. Settings of the
# environment: of glibc 2.36 and, with its other names, of later ones (unknown names are ignored), of
# OpenCV without anything above SSE2, of Mesa without AVX and FMA.
glibc=GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-AVX2,-FMA,-FMA4,-AVX512F
opencv=OPENCV_CPU_DISABLE=SSE4.1,SSE4.2,AVX,FP16,AVX2,FMA3,AVX512F,AVX512-SKX
mesa=GALLIUM_OVERRIDE_CPU_CAPS=sse4.1
