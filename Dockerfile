# SPDX-License-Identifier: LGPL-2.1-or-later
# The Debian packages of Myolines, built and installed: docker build -t myolines . (or podman); --build-arg DEBIAN=12 for the older system.
# Run as: docker run --rm -v "$PWD:/work" myolines run scene.xml
ARG DEBIAN=13
FROM debian:${DEBIAN} AS build
COPY . /src/myolines
RUN /src/myolines/myolines.sh package

FROM debian:${DEBIAN}
ARG DEBIAN_FRONTEND=noninteractive
COPY --from=build /src/myolines/build/release/myolines_*.deb /tmp/
RUN apt-get update -qq && apt-get install -y -qq /tmp/myolines_*.deb && rm -rf /tmp/*.deb /var/lib/apt/lists/*
ENV OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 \
    PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
WORKDIR /work
ENTRYPOINT ["myolines"]
