# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
#   docker build -t vinebench .
#   docker run --rm -v "$PWD:/work" vinebench run quick-loop
#
# tools/packages.sh docker executes these lines where there is no Docker.

# Everything that a build needs; .devcontainer/ stops here.
FROM debian:12-slim AS tools
WORKDIR /src
COPY tools/setup.sh tools/setup.sh
RUN tools/setup.sh --packages

FROM tools AS build
COPY . .
RUN cmake --workflow --preset deb
RUN mkdir /packages && cp build-deb/*.deb /packages

# The program and its Python module with the libraries that they need.
FROM debian:12-slim
COPY --from=build /packages /packages
RUN apt-get update -qq && \
    apt-get install -y -qq --no-install-recommends /packages/vinebench_*.deb /packages/python3-vinebench_*.deb && \
    rm -rf /packages /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["vinebench"]
CMD ["help"]
