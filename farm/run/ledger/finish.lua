-- Notes that an owner has finished a job, forgets what was counted of the job, and gives the claim up.
--
-- KEYS[1]  claims: sorted set of job ids; the score is when the claim lapses, in seconds of the Unix epoch
-- KEYS[2]  owners: hash from job id to the owner of its claim
-- KEYS[3]  starts: hash from job id to the number of its starts
-- KEYS[4]  troubles: hash from job id to the number of its failures that may pass
-- KEYS[5]  logs: hash from job id to what it printed before its process ended
-- KEYS[6]  finished: list of when jobs were finished, in seconds of the Unix epoch, the newest first
-- KEYS[7]  last: path of the newest picture below the dataset's folder
-- ARGV[1]  job id
-- ARGV[2]  owner that holds the claim
-- ARGV[3]  path of the job's picture below the dataset's folder
-- ARGV[4]  entries that the list `finished` keeps
-- ARGV[5]  seconds for which `finished` and `last` are kept after this write
-- Returns  1; 0 if the claim is not the owner's, and then nothing changes

if redis.call('HGET', KEYS[2], ARGV[1]) ~= ARGV[2] then
    return 0
end

local time = redis.call('TIME')
local now = time[1] + time[2] / 1e6
redis.call('ZREM', KEYS[1], ARGV[1])
for place = 2, 5 do
    redis.call('HDEL', KEYS[place], ARGV[1])
end
redis.call('LPUSH', KEYS[6], string.format('%.3f', now))
redis.call('LTRIM', KEYS[6], 0, ARGV[4] - 1)
redis.call('EXPIRE', KEYS[6], ARGV[5])
redis.call('SET', KEYS[7], ARGV[3], 'EX', ARGV[5])
return 1
