/* SPDX-FileCopyrightText: Vinebench authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A shared object that is no SLAM system. */
int vinebench_no_slam(void);
int vinebench_no_slam(void) { return 0; }
